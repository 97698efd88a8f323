/* image_strip.c - texture files as they are embedded: checked for wholeness, without metadata;
 * and colours.
 *
 * Cameras and editors put previews, places and colour profiles into image files. glTF ignores
 * them, some viewers do not, and they can be larger than the picture itself.
 */
#include "stdlib/io/io.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/real.h"

/* ---- PNG: a signature, then chunks of length, type, data, checksum --------------------------- */

enum { PNG_SIGNATURE = 8, PNG_CHUNK_HEAD = 8, PNG_CHUNK_EXTRA = 12 };

static uint32_t big_endian(const unsigned char *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | (uint32_t)b[3];
}

static bool png_chunk_kept(const unsigned char *type)
{
    static const char kept[][5] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
    for (size_t i = 0; i < COUNT_OF(kept); i++)
        if (memcmp(type, kept[i], 4) == 0)
            return true;
    return false;
}

static size_t strip_png(const unsigned char *bytes, size_t size, unsigned char *out, bool *alpha)
{
    size_t at = PNG_SIGNATURE, length = PNG_SIGNATURE;
    bool data = false;
    memcpy(out, bytes, PNG_SIGNATURE);
    while (size - at >= PNG_CHUNK_EXTRA) {
        const unsigned char *type = bytes + at + 4;
        size_t whole = (size_t)big_endian(bytes + at) + PNG_CHUNK_EXTRA;
        if (whole > size - at)
            return 0;
        if (at == PNG_SIGNATURE && (memcmp(type, "IHDR", 4) != 0 || whole < PNG_CHUNK_EXTRA + 13))
            return 0;
        if (memcmp(type, "IHDR", 4) == 0)
            *alpha = (bytes[at + PNG_CHUNK_HEAD + 9] & 4) != 0; /* the colour type */
        *alpha = *alpha || memcmp(type, "tRNS", 4) == 0;
        data = data || memcmp(type, "IDAT", 4) == 0;
        if (png_chunk_kept(type)) {
            memcpy(out + length, bytes + at, whole);
            length += whole;
        }
        if (memcmp(type, "IEND", 4) == 0)
            return data ? length : 0;
        at += whole;
    }
    return 0;
}

/* ---- JPEG: segments of 0xff, marker, length, data; scans of data without a length ------------ */

enum { JPEG_TEM = 0x01, JPEG_RST0 = 0xd0, JPEG_RST7 = 0xd7, JPEG_SOI = 0xd8, JPEG_EOI = 0xd9,
       JPEG_SOS = 0xda, JPEG_APP1 = 0xe1, JPEG_APP14 = 0xee, JPEG_APP15 = 0xef, JPEG_COM = 0xfe };

/* The end of the data of a scan: the next marker that is none of its own. */
static size_t scan_end(const unsigned char *bytes, size_t size, size_t at)
{
    while (at + 1 < size) {
        if (bytes[at] != 0xff) {
            at++;
            continue;
        }
        unsigned char next = bytes[at + 1];
        if (next != 0 && !(next >= JPEG_RST0 && next <= JPEG_RST7) && next != 0xff)
            return at;
        at += next == 0xff ? 1 : 2;
    }
    return size;
}

static bool jpeg_segment_kept(unsigned marker)
{
    bool application = marker >= JPEG_APP1 && marker <= JPEG_APP15;
    return marker != JPEG_COM && (!application || marker == JPEG_APP14);
}

static size_t strip_jpeg(const unsigned char *bytes, size_t size, unsigned char *out)
{
    size_t at = 2, length = 2;
    bool data = false;
    memcpy(out, bytes, 2);
    while (at + 1 < size && bytes[at] == 0xff) {
        unsigned marker = bytes[at + 1];
        if (marker == 0xff) { /* padding */
            at++;
            continue;
        }
        if (marker == JPEG_EOI) {
            memcpy(out + length, bytes + at, 2);
            return data ? length + 2 : 0;
        }
        if (marker <= JPEG_TEM || (marker >= JPEG_RST0 && marker <= JPEG_SOI) || size - at < 4)
            return 0;
        size_t whole = 2 + ((size_t)bytes[at + 2] << 8 | (size_t)bytes[at + 3]);
        if (whole < 4 || whole > size - at)
            return 0;
        if (marker == JPEG_SOS) {
            whole = scan_end(bytes, size, at + whole) - at;
            data = true;
        }
        if (jpeg_segment_kept(marker)) {
            memcpy(out + length, bytes + at, whole);
            length += whole;
        }
        at += whole;
    }
    return 0;
}

/* ---- both ------------------------------------------------------------------------------------ */

const unsigned char *image_file_strip(io_job *j, const unsigned char *bytes, size_t size,
                                      size_t *stripped, bool *alpha)
{
    unsigned char *out = arena_alloc(&j->memory, size);
    *alpha = false;
    *stripped = 0;
    switch (image_kind(bytes, size)) {
    case IO_IMAGE_PNG:
        *stripped = strip_png(bytes, size, out, alpha);
        break;
    case IO_IMAGE_JPEG:
        *stripped = strip_jpeg(bytes, size, out);
        break;
    case IO_IMAGE_OTHER:
        break;
    }
    return *stripped ? out : NULL;
}

const char *image_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

/* The open file's bytes; NULL with errno set. Only what is a file is read: a pipe would never
 * end. */
static unsigned char *read_file(io_job *j, int file, size_t *size)
{
    struct stat s;
    if (fstat(file, &s) != 0)
        return NULL;
    errno = S_ISDIR(s.st_mode) ? EISDIR : !S_ISREG(s.st_mode) ? EINVAL : EFBIG;
    if (!S_ISREG(s.st_mode) || s.st_size > IO_IMAGE_BYTES_MAX)
        return NULL;
    j->memory.on_failure = NULL; /* no jump while the file is open */
    unsigned char *bytes = arena_alloc(&j->memory, (size_t)s.st_size);
    j->memory.on_failure = &j->out_of_memory;
    errno = ENOMEM;
    *size = 0;
    while (bytes && *size < (size_t)s.st_size) {
        ssize_t got = read(file, bytes + *size, (size_t)s.st_size - *size);
        if (got == 0)
            break;
        if (got < 0 && errno != EINTR)
            return NULL;
        *size += got > 0 ? (size_t)got : 0;
    }
    return bytes;
}

const unsigned char *image_file_read(io_job *j, const char *path, size_t *size)
{
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    unsigned char *bytes = file >= 0 ? read_file(j, file, size) : NULL;
    if (!bytes)
        result_warn(j->run, "the texture '%s' cannot be read (%s): its surfaces stay plain",
                    image_file_name(path), strerror(errno));
    if (file >= 0)
        close(file);
    if (bytes && image_kind(bytes, *size) == IO_IMAGE_OTHER) {
        result_warn(j->run, "the texture '%s' is neither PNG nor JPEG: its surfaces stay plain",
                    image_file_name(path));
        return NULL;
    }
    return bytes;
}

double color_linear(double srgb)
{
    if (!(srgb > 0))
        return 0;
    if (srgb >= 1)
        return 1;
    return srgb <= 0.04045 ? srgb / 12.92 : real_pow((srgb + 0.055) / 1.055, 2.4);
}

double color_srgb(double linear)
{
    if (!(linear > 0))
        return 0;
    if (linear >= 1)
        return 1;
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * real_pow(linear, 1 / 2.4) - 0.055;
}
