/* image_file.c - reads PNG and JPEG, through libpng and libjpeg, which are opened when first used.
 *
 * Files come from anywhere: nothing in them may end the process or take more memory than the
 * limits say. Both libraries report errors by jumping out of their calls; the jumps end in this
 * file.
 */
#include "stdlib/io/io.h"

#include <dlfcn.h>
#include <string.h>

#ifdef PCG_PNG_LIBRARY
#include <png.h>
#endif
#ifdef PCG_JPEG_LIBRARY
#include <jpeglib.h>
#include <jerror.h>
#endif

io_image_kind image_kind(const unsigned char *bytes, size_t size)
{
    static const unsigned char png[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (size >= sizeof png && memcmp(bytes, png, sizeof png) == 0)
        return IO_IMAGE_PNG;
    if (size >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff)
        return IO_IMAGE_JPEG;
    return IO_IMAGE_OTHER;
}

#if defined(PCG_PNG_LIBRARY) || defined(PCG_JPEG_LIBRARY)

/* dlsym gives functions as data pointers, which C does not convert. */
static bool find_symbol(void *library, const char *name, void *function, size_t size)
{
    void *address = dlsym(library, name);
    memcpy(function, &address, size);
    return address != NULL;
}

#define FIND(library, table, name)                                                                 \
    find_symbol((library), #name, &(table)->name, sizeof(table)->name)

static const char *check_size(uint32_t width, uint32_t height)
{
    if (!width || !height)
        return "it has no pixels";
    if (width > IO_IMAGE_SIDE_MAX || height > IO_IMAGE_SIDE_MAX ||
        (uint64_t)width * height > IO_IMAGE_PIXELS_MAX)
        return "it has more pixels than the limit of 16384 a side and 67 million in all";
    return NULL;
}

#endif

/* ---- PNG ------------------------------------------------------------------------------------- */

#ifdef PCG_PNG_LIBRARY

typedef struct png_library {
    int (*png_image_begin_read_from_memory)(png_imagep, png_const_voidp, size_t);
    int (*png_image_finish_read)(png_imagep, png_const_colorp, void *, png_int_32, void *);
    void (*png_image_free)(png_imagep);
} png_library;

static const char *png_open(io_job *j, png_library *l)
{
    if (!j->png)
        j->png = dlopen(PCG_PNG_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (j->png && FIND(j->png, l, png_image_begin_read_from_memory) &&
        FIND(j->png, l, png_image_finish_read) && FIND(j->png, l, png_image_free))
        return NULL;
    return "the library " PCG_PNG_LIBRARY " cannot be loaded; install it";
}

static bool all_opaque(const unsigned char *pixels, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (pixels[4 * i + 3] != 255)
            return false;
    return true;
}

static const char *png_decode(io_job *j, const unsigned char *bytes, size_t size, io_image *out)
{
    png_library l;
    const char *wrong = png_open(j, &l);
    if (wrong)
        return wrong;
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (l.png_image_begin_read_from_memory(&image, bytes, size))
        wrong = check_size(image.width, image.height);
    else
        wrong = arena_format(&j->memory, "%s", image.message);
    if (!wrong) {
        size_t count = (size_t)image.width * image.height;
        j->memory.on_failure = NULL; /* no jump while the library holds memory of its own */
        out->pixels = arena_alloc(&j->memory, 4 * count);
        j->memory.on_failure = &j->out_of_memory;
        out->width = image.width;
        out->height = image.height;
        image.format = PNG_FORMAT_RGBA;
        if (!out->pixels)
            wrong = "there is no memory for it";
        else if (!l.png_image_finish_read(&image, NULL, out->pixels, 0, NULL))
            wrong = arena_format(&j->memory, "%s", image.message);
        out->opaque = !wrong && all_opaque(out->pixels, count);
    }
    l.png_image_free(&image);
    return wrong;
}

#else

static const char *png_decode(io_job *j, const unsigned char *bytes, size_t size, io_image *out)
{
    (void)bytes, (void)size, (void)out;
    return image_png_missing(j);
}

#endif

bool image_png_built(void)
{
#ifdef PCG_PNG_LIBRARY
    return true;
#else
    return false;
#endif
}

/* ---- JPEG ------------------------------------------------------------------------------------ */

#ifdef PCG_JPEG_LIBRARY

enum { JPEG_SCANS_MAX = 200, JPEG_MEMORY_MAX = 512 << 20 };

typedef struct jpeg_library {
    struct jpeg_error_mgr *(*jpeg_std_error)(struct jpeg_error_mgr *);
    void (*jpeg_CreateDecompress)(j_decompress_ptr, int, size_t);
    void (*jpeg_mem_src)(j_decompress_ptr, const unsigned char *, unsigned long);
    int (*jpeg_read_header)(j_decompress_ptr, boolean);
    boolean (*jpeg_start_decompress)(j_decompress_ptr);
    JDIMENSION (*jpeg_read_scanlines)(j_decompress_ptr, JSAMPARRAY, JDIMENSION);
    boolean (*jpeg_finish_decompress)(j_decompress_ptr);
    void (*jpeg_destroy_decompress)(j_decompress_ptr);
} jpeg_library;

/* One decoding. The error manager and the progress monitor stand first in what contains them, so
 * that the library's callbacks find their way back. */
typedef struct jpeg_decoder {
    struct jpeg_error_mgr errors; /* first */
    jmp_buf failed;
    char message[JMSG_LENGTH_MAX];
    struct jpeg_progress_mgr progress;
    struct jpeg_decompress_struct info;
    jpeg_library library;
    io_job *job;
    const unsigned char *bytes;
    size_t size;
    uint32_t enough;
    io_image *out;
    unsigned char *row;
} jpeg_decoder;

static const char *jpeg_open(io_job *j, jpeg_library *l)
{
    if (!j->jpeg)
        j->jpeg = dlopen(PCG_JPEG_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (j->jpeg && FIND(j->jpeg, l, jpeg_std_error) && FIND(j->jpeg, l, jpeg_CreateDecompress) &&
        FIND(j->jpeg, l, jpeg_mem_src) && FIND(j->jpeg, l, jpeg_read_header) &&
        FIND(j->jpeg, l, jpeg_start_decompress) && FIND(j->jpeg, l, jpeg_read_scanlines) &&
        FIND(j->jpeg, l, jpeg_finish_decompress) && FIND(j->jpeg, l, jpeg_destroy_decompress))
        return NULL;
    return "the library " PCG_JPEG_LIBRARY " cannot be loaded; install it";
}

static void jpeg_give_up(jpeg_decoder *d, const char *why)
{
    snprintf(d->message, sizeof d->message, "%s", why);
    longjmp(d->failed, 1);
}

static void on_jpeg_error(j_common_ptr info)
{
    jpeg_decoder *d = (jpeg_decoder *)(void *)info->err;
    info->err->format_message(info, d->message);
    longjmp(d->failed, 1);
}

/* Most warnings are about oddities that do not show; a file that ends too early, or whose data
 * makes no sense, does. */
static void on_jpeg_message(j_common_ptr info, int level)
{
    int code = info->err->msg_code;
    bool shows = code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE;
    if (level < 0 && shows)
        on_jpeg_error(info);
}

static void on_jpeg_output(j_common_ptr info)
{
    (void)info;
}

/* A small progressive file can ask for thousands of passes over a large image. */
static void on_jpeg_progress(j_common_ptr info)
{
    jpeg_decoder *d = (jpeg_decoder *)(void *)info->err;
    if (d->info.input_scan_number > JPEG_SCANS_MAX)
        jpeg_give_up(d, "it is built to take very long to decode");
}

static void jpeg_choose_size(jpeg_decoder *d)
{
    uint32_t side = d->info.image_width < d->info.image_height ? d->info.image_width
                                                               : d->info.image_height;
    unsigned denominator = 1;
    while (d->enough && denominator < 8 && side / (2 * denominator) >= d->enough)
        denominator *= 2;
    d->info.scale_num = 1;
    d->info.scale_denom = denominator;
}

static void jpeg_read_rows(jpeg_decoder *d)
{
    struct jpeg_decompress_struct *info = &d->info;
    size_t width = info->output_width, step = (size_t)info->output_components;
    while (info->output_scanline < info->output_height) {
        unsigned char *to = d->out->pixels + 4 * width * info->output_scanline;
        if (d->library.jpeg_read_scanlines(info, &d->row, 1) != 1)
            jpeg_give_up(d, "it ends too early");
        for (size_t x = 0; x < width; x++) {
            const unsigned char *from = d->row + step * x;
            to[4 * x] = from[0];
            to[4 * x + 1] = from[step == 3 ? 1 : 0];
            to[4 * x + 2] = from[step == 3 ? 2 : 0];
            to[4 * x + 3] = 255;
        }
    }
}

static void jpeg_run(jpeg_decoder *d)
{
    struct jpeg_decompress_struct *info = &d->info;
    d->library.jpeg_CreateDecompress(info, JPEG_LIB_VERSION, sizeof *info);
    info->mem->max_memory_to_use = JPEG_MEMORY_MAX;
    d->progress.progress_monitor = on_jpeg_progress;
    info->progress = &d->progress;
    d->library.jpeg_mem_src(info, d->bytes, (unsigned long)d->size);
    d->library.jpeg_read_header(info, TRUE);
    const char *wrong = check_size(info->image_width, info->image_height);
    if (wrong)
        jpeg_give_up(d, wrong);
    if (info->jpeg_color_space == JCS_CMYK || info->jpeg_color_space == JCS_YCCK)
        jpeg_give_up(d, "its colours are those of print (CMYK)");
    jpeg_choose_size(d);
    info->out_color_space = info->num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    d->library.jpeg_start_decompress(info);
    size_t pixels = (size_t)info->output_width * info->output_height;
    d->out->width = info->output_width;
    d->out->height = info->output_height;
    d->out->opaque = true;
    d->out->pixels = arena_alloc(&d->job->memory, 4 * pixels);
    d->row = arena_alloc(&d->job->memory, (size_t)info->output_width * 4);
    jpeg_read_rows(d);
    d->library.jpeg_finish_decompress(info);
}

/* Where memory runs out, the arena jumps here, so that the library gives back its own. */
static const char *jpeg_decode(io_job *j, const unsigned char *bytes, size_t size, uint32_t enough,
                               io_image *out)
{
    jpeg_decoder *d = ARENA_NEW(&j->memory, jpeg_decoder);
    const char *wrong = jpeg_open(j, &d->library);
    if (wrong)
        return wrong;
    d->job = j;
    d->bytes = bytes;
    d->size = size;
    d->enough = enough;
    d->out = out;
    d->info.err = d->library.jpeg_std_error(&d->errors);
    d->errors.error_exit = on_jpeg_error;
    d->errors.emit_message = on_jpeg_message;
    d->errors.output_message = on_jpeg_output;
    snprintf(d->message, sizeof d->message, "there is no memory for it");
    j->memory.on_failure = &d->failed;
    if (setjmp(d->failed) == 0)
        jpeg_run(d);
    else
        d->row = NULL;
    bool failed = !d->row;
    j->memory.on_failure = &j->out_of_memory;
    d->library.jpeg_destroy_decompress(&d->info);
    return failed ? d->message : NULL;
}

#else

static const char *jpeg_decode(io_job *j, const unsigned char *bytes, size_t size, uint32_t enough,
                               io_image *out)
{
    (void)j, (void)bytes, (void)size, (void)enough, (void)out;
    return "JPEG was left out when this program was built (configure --without-jpeg)";
}

#endif

/* ---- both ------------------------------------------------------------------------------------ */

const char *image_decode(io_job *j, const unsigned char *bytes, size_t size, uint32_t enough,
                         io_image *out)
{
    *out = (io_image){0};
    switch (image_kind(bytes, size)) {
    case IO_IMAGE_PNG:
        return png_decode(j, bytes, size, out);
    case IO_IMAGE_JPEG:
        return jpeg_decode(j, bytes, size, enough, out);
    case IO_IMAGE_OTHER:
        break;
    }
    return "it is neither PNG nor JPEG";
}

void image_libraries_close(io_job *j)
{
    if (j->png)
        dlclose(j->png);
    if (j->jpeg)
        dlclose(j->jpeg);
    j->png = j->jpeg = NULL;
}
