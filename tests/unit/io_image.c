/* io_image.c - PNG and JPEG files of every kind of brokenness are a message, never a crash. */
#include <unistd.h>

#include "stdlib/io/io.h"
#include "tests/unit/io_studio.h"

enum { WIDTH = 40, HEIGHT = 30 };

/* A job without a result: enough for images. */
typedef struct bench {
    io_job job;
    unsigned char *png;
    size_t png_size;
} bench;

/* A build may do without either library: that is what it then says. */
static bool left_out(const char *message)
{
    return message && strstr(message, "was left out when this program was built");
}

static void open_bench(bench *b, pcg_run *run)
{
    unsigned char pixels[WIDTH * HEIGHT * 3];
    memset(b, 0, sizeof *b);
    b->job.run = run;
    b->job.memory.on_failure = &b->job.out_of_memory;
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        pixels[i] = (unsigned char)(i * 7 + i / 64);
    const char *wrong = image_encode_png(&b->job, pixels, WIDTH, HEIGHT, &b->png, &b->png_size);
    CHECK(!wrong || left_out(wrong));
}

static void close_bench(bench *b)
{
    image_libraries_close(&b->job);
    arena_free(&b->job.memory);
}

static void png_survives(bench *b)
{
    io_image image;
    int same = 0;
    CHECK(image_kind(b->png, b->png_size) == IO_IMAGE_PNG);
    CHECK(image_decode(&b->job, b->png, b->png_size, 0, &image) == NULL);
    CHECK(image.width == WIDTH && image.height == HEIGHT && image.opaque);
    for (int i = 0; image.pixels && i < WIDTH * HEIGHT; i++)
        for (int k = 0; k < 3; k++)
            same += image.pixels[4 * i + k] == (unsigned char)((3 * i + k) * 7 + (3 * i + k) / 64);
    CHECK_INTEGER(same, WIDTH * HEIGHT * 3);
}

/* Decodes the file cut off at many lengths, and with single bytes changed. Returns how many of
 * the cut ones were taken for whole. */
static int batter(bench *b, const unsigned char *bytes, size_t size, size_t step)
{
    unsigned char *copy = malloc(size);
    int whole = 0;
    for (size_t length = 0; length < size; length += step) {
        io_image image;
        memcpy(copy, bytes, length);
        whole += image_decode(&b->job, copy, length, 0, &image) == NULL;
    }
    for (size_t at = 0; at < size; at += step) {
        io_image image;
        memcpy(copy, bytes, size);
        copy[at] ^= (unsigned char)(1 + at % 255);
        image_decode(&b->job, copy, size, 0, &image);
    }
    free(copy);
    return whole;
}

/* What stands behind the pixels may be cut off: nothing more than the end mark of 12 bytes. */
static void broken_png_is_a_message(bench *b)
{
    static const unsigned char huge[] = {
        0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I',  'H',  'D',  'R', 0x00,
        0x0f, 0x42, 0x40, 0x00, 0x0f, 0x42, 0x40, 8,    2, 0, 0, 0,  0x1c, 0x71, 0xdc, 0x3d};
    io_image image;
    CHECK(batter(b, b->png, b->png_size, 1) <= 12);
    CHECK(image_decode(&b->job, huge, sizeof huge, 0, &image) != NULL);
    CHECK_TEXT(image_decode(&b->job, (const unsigned char *)"GIF89a", 6, 0, &image),
               "it is neither PNG nor JPEG");
    CHECK(image_decode(&b->job, b->png, 0, 0, &image) != NULL);
}

static void jpeg_is_read(bench *b)
{
    size_t size = 0;
    const unsigned char *bytes = image_file_read(&b->job, studio_brick(), &size);
    io_image image, small;
    CHECK(bytes && image_kind(bytes, size) == IO_IMAGE_JPEG);
    if (!bytes)
        return;
    const char *wrong = image_decode(&b->job, bytes, size, 0, &image);
    if (left_out(wrong))
        return;
    CHECK(!wrong);
    CHECK(image.width >= 16 && image.height >= 16 && image.opaque);
    CHECK(image_decode(&b->job, bytes, size, image.width / 4, &small) == NULL);
    CHECK_INTEGER(small.width, (image.width + 3) / 4);
    CHECK(batter(b, bytes, size, 97) == 0);
    CHECK_TEXT(image_decode(&b->job, bytes, size / 2, 0, &image), "Premature end of JPEG file");
}

static void stripping_keeps_the_picture(bench *b)
{
    static const unsigned char text_chunk[] = {0,   0, 0,   4,   't', 'E', 'X', 't',
                                               'a', 0, 'b', 'c', 1,   2,   3,   4};
    size_t head = 8 + 25, size = 0, again = 0, stripped = 0;
    bool alpha = true;
    unsigned char *with = malloc(b->png_size + sizeof text_chunk);
    const unsigned char *plain = image_file_strip(&b->job, b->png, b->png_size, &again, &alpha);
    CHECK(plain && again <= b->png_size && !alpha);
    memcpy(with, b->png, head);
    memcpy(with + head, text_chunk, sizeof text_chunk);
    memcpy(with + head + sizeof text_chunk, b->png + head, b->png_size - head);
    size = b->png_size + sizeof text_chunk;
    const unsigned char *out = image_file_strip(&b->job, with, size, &stripped, &alpha);
    CHECK(out && plain && stripped == again && memcmp(out, plain, again) == 0);
    for (size_t length = 0; length < b->png_size; length++)
        CHECK(length >= b->png_size - 12 ||
              !image_file_strip(&b->job, b->png, length, &stripped, &alpha));
    free(with);
}

static void stripping_jpeg_drops_metadata(bench *b)
{
    static const unsigned char exif[] = {0xff, 0xe1, 0, 8, 'E', 'x', 'i', 'f', 0, 0};
    size_t size = 0, stripped = 0, again = 0;
    bool alpha = true;
    const unsigned char *bytes = image_file_read(&b->job, studio_brick(), &size);
    if (!bytes)
        return;
    const unsigned char *plain = image_file_strip(&b->job, bytes, size, &stripped, &alpha);
    CHECK(plain && stripped <= size && !alpha);
    unsigned char *with = malloc(size + sizeof exif);
    memcpy(with, bytes, 2);
    memcpy(with + 2, exif, sizeof exif);
    memcpy(with + 2 + sizeof exif, bytes + 2, size - 2);
    const unsigned char *out = image_file_strip(&b->job, with, size + sizeof exif, &again, &alpha);
    CHECK(out && plain && again == stripped && memcmp(out, plain, again) == 0);
    for (size_t length = 0; length + 2 < size; length += 31)
        CHECK(!image_file_strip(&b->job, bytes, length, &again, &alpha));
    io_image image;
    const char *wrong = plain ? image_decode(&b->job, plain, stripped, 0, &image) : "no file";
    CHECK(!wrong || left_out(wrong));
    free(with);
}

static void missing_files_are_warnings(bench *b)
{
    char messages[2048];
    const studio_result r = {.run = b->job.run};
    size_t size;
    CHECK(image_file_read(&b->job, studio_path("none.png"), &size) == NULL);
    CHECK(image_file_read(&b->job, studio_folder, &size) == NULL);
    CHECK(image_file_read(&b->job, "/dev/zero", &size) == NULL);
    studio_write("text.png", "hello", 5);
    CHECK(image_file_read(&b->job, studio_path("text.png"), &size) == NULL);
    studio_messages(&r, messages, sizeof messages);
    CHECK(strstr(messages, "the texture 'none.png' cannot be read (No such file or directory)") !=
          NULL);
    CHECK(strstr(messages, "cannot be read (Is a directory)") != NULL);
    CHECK(strstr(messages, "the texture 'zero' cannot be read") != NULL);
    CHECK(strstr(messages, "the texture 'text.png' is neither PNG nor JPEG") != NULL);
}

static void colors_go_there_and_back(void)
{
    CHECK(color_linear(0) <= 0 && color_linear(1) >= 1 && color_linear(-3) <= 0);
    CHECK(color_linear(0.5) > 0.2140 && color_linear(0.5) < 0.2141);
    for (int i = 0; i <= 255; i++)
        CHECK((int)(color_srgb(color_linear(i / 255.0)) * 255 + 0.5) == i);
}

int main(void)
{
    studio_open_folder();
    studio_result r = studio_make(NULL);
    bench b;
    open_bench(&b, r.run);
    if (b.png) {
        png_survives(&b);
        broken_png_is_a_message(&b);
        stripping_keeps_the_picture(&b);
    }
    jpeg_is_read(&b);
    stripping_jpeg_drops_metadata(&b);
    missing_files_are_warnings(&b);
    colors_go_there_and_back();
    close_bench(&b);
    studio_free(&r);
    studio_close_folder();
    return unit_done();
}
