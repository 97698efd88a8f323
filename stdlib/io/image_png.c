/* image_png.c - writes PNG files, in strips that are compressed by several threads.
 *
 * Rows are filtered and compressed here, by the zlib that comes with libpng. A strip is some rows;
 * each is compressed by itself and ends on a whole byte, so that strips follow each other as one
 * stream, whatever thread made them. Method: that of pigz, by Adler. The format: W3C, Portable
 * Network Graphics, second edition.
 */
#include "stdlib/io/io.h"

#ifdef PCG_PNG_LIBRARY

#include <dlfcn.h>
#include <string.h>
#include <zlib.h>

/* Rows of a strip; the level above which compressing takes long for little; bytes a pixel. */
enum { STRIP_ROWS = 64, LEVEL = 5, BYTES = 3, FILTERS = 5, HEAD = 8, CHUNK = 12 };

typedef struct library {
    int (*deflateInit2_)(z_streamp, int, int, int, int, int, const char *, int);
    int (*deflate)(z_streamp, int);
    int (*deflateEnd)(z_streamp);
    uLong (*deflateBound)(z_streamp, uLong);
    uLong (*crc32)(uLong, const Bytef *, uInt);
    uLong (*adler32)(uLong, const Bytef *, uInt);
    uLong (*adler32_combine)(uLong, uLong, z_off_t);
} library;

typedef struct strip {
    unsigned char *bytes;        /* compressed */
    size_t size, room;
    uint32_t first, end;         /* rows */
    uLong sum;
    bool failed;
} strip;

typedef struct encoding {
    io_job *job;
    library zlib;
    const unsigned char *pixels;
    uint32_t width, height;
    size_t row;                  /* bytes: a filter and the pixels */
    strip *strips;
    uint32_t count;
    unsigned char **filtered;    /* of each thread: the rows of a strip, and room to try */
} encoding;

/* dlsym gives functions as data pointers, which C does not convert. */
static bool find_symbol(void *from, const char *name, void *function, size_t size)
{
    void *address = dlsym(from, name);
    memcpy(function, &address, size);
    return address != NULL;
}

#define FIND(from, table, name) find_symbol((from), #name, &(table)->name, sizeof(table)->name)

/* What libpng needs can be found through it. */
static const char *open_library(io_job *j, library *l)
{
    if (!j->png)
        j->png = dlopen(PCG_PNG_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (j->png && FIND(j->png, l, deflateInit2_) && FIND(j->png, l, deflate) &&
        FIND(j->png, l, deflateEnd) && FIND(j->png, l, deflateBound) && FIND(j->png, l, crc32) &&
        FIND(j->png, l, adler32) && FIND(j->png, l, adler32_combine))
        return NULL;
    return "the library " PCG_PNG_LIBRARY " cannot be loaded; install it";
}

const char *image_png_missing(io_job *j)
{
    library l;
    return open_library(j, &l);
}

/* ---- rows ------------------------------------------------------------------------------------ */

static int paeth(int left, int above, int corner)
{
    int x = above - corner, y = left - corner, both = x + y;
    x = x < 0 ? -x : x;
    y = y < 0 ? -y : y;
    both = both < 0 ? -both : both;
    return x <= y && x <= both ? left : y <= both ? above : corner;
}

/* A row less what one expects of it; the filters are those of the format. Returns how large the
 * differences are. */
static uint64_t filter(int kind, const unsigned char *row, const unsigned char *above, size_t size,
                       unsigned char *out)
{
    uint64_t sum = 0;
    out[0] = (unsigned char)kind;
    for (size_t i = 0; i < size; i++) {
        int left = i >= BYTES ? row[i - BYTES] : 0, up = above ? above[i] : 0;
        int corner = above && i >= BYTES ? above[i - BYTES] : 0;
        int expected = kind == 0   ? 0
                       : kind == 1 ? left
                       : kind == 2 ? up
                       : kind == 3 ? (left + up) / 2
                                   : paeth(left, up, corner);
        unsigned char rest = (unsigned char)(row[i] - expected);
        out[i + 1] = rest;
        sum += rest < 128 ? rest : 256u - rest;
    }
    return sum;
}

/* The filter that leaves the smallest differences. */
static void filter_row(const encoding *e, uint32_t y, unsigned char *out, unsigned char *other)
{
    size_t size = e->row - 1;
    const unsigned char *row = e->pixels + size * y, *above = y ? row - size : NULL;
    uint64_t best = filter(0, row, above, size, out);
    for (int kind = 1; kind < FILTERS; kind++) {
        uint64_t sum = filter(kind, row, above, size, other);
        if (sum < best) {
            memcpy(out, other, e->row);
            best = sum;
        }
    }
}

static void compress_strip(void *context, uint32_t thread, uint32_t item)
{
    const encoding *e = context;
    strip *s = &e->strips[item];
    unsigned char *rows = e->filtered[thread];
    uInt size = (uInt)(e->row * (s->end - s->first));
    z_stream z = {.next_in = rows, .avail_in = size};
    for (uint32_t y = s->first; y < s->end; y++)
        filter_row(e, y, rows + e->row * (y - s->first), rows + e->row * STRIP_ROWS);
    s->sum = e->zlib.adler32(1, rows, size);
    s->failed = true;
    if (e->zlib.deflateInit2_(&z, LEVEL, Z_DEFLATED, -15, 8, Z_FILTERED, ZLIB_VERSION,
                              (int)sizeof z) != Z_OK)
        return;
    z.next_out = s->bytes;
    z.avail_out = (uInt)s->room;
    bool last = s->end == e->height;
    int status = e->zlib.deflate(&z, last ? Z_FINISH : Z_SYNC_FLUSH);
    s->size = s->room - z.avail_out;
    s->failed = z.avail_in || !z.avail_out || status != (last ? Z_STREAM_END : Z_OK);
    e->zlib.deflateEnd(&z);
}

/* ---- the file -------------------------------------------------------------------------------- */

static unsigned char *put_word(unsigned char *to, uLong word)
{
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(word >> (24 - 8 * i) & 0xff);
    return to + 4;
}

/* A chunk whose content stands where it belongs already, behind its head. Returns its end. */
static unsigned char *end_chunk(const encoding *e, unsigned char *at, const char *kind, size_t size)
{
    put_word(at, (uLong)size);
    memcpy(at + 4, kind, 4);
    return put_word(at + 8 + size, e->zlib.crc32(0, at + 4, (uInt)(size + 4)));
}

static unsigned char *put_head(const encoding *e, unsigned char *to)
{
    static const unsigned char magic[HEAD] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const unsigned char rgb[5] = {8, 2, 0, 0, 0}; /* bits, colours, and the usual */
    memcpy(to, magic, sizeof magic);
    to += sizeof magic;
    memcpy(put_word(put_word(to + 8, e->width), e->height), rgb, sizeof rgb);
    return end_chunk(e, to, "IHDR", 13);
}

/* A chunk of data a strip; the first has the head of the stream, the last the sum of all. */
static unsigned char *put_strips(const encoding *e, unsigned char *to)
{
    static const unsigned char stream[2] = {0x78, 0x5e};
    uLong sum = 1;
    for (uint32_t i = 0; i < e->count; i++) {
        const strip *s = &e->strips[i];
        unsigned char *at = to + 8;
        if (i == 0)
            memcpy(at, stream, sizeof stream);
        at += i == 0 ? sizeof stream : 0;
        memcpy(at, s->bytes, s->size);
        at += s->size;
        sum = e->zlib.adler32_combine(sum, s->sum, (z_off_t)(e->row * (s->end - s->first)));
        if (i + 1 == e->count)
            at = put_word(at, sum);
        to = end_chunk(e, to, "IDAT", (size_t)(at - to) - 8);
    }
    return end_chunk(e, to, "IEND", 0);
}

static void prepare(encoding *e)
{
    arena *a = &e->job->memory;
    uint32_t threads = io_threads(e->job);
    z_stream none = {0};
    e->count = (e->height + STRIP_ROWS - 1) / STRIP_ROWS;
    e->strips = ARENA_ARRAY(a, strip, e->count);
    for (uint32_t i = 0; i < e->count; i++) {
        strip *s = &e->strips[i];
        s->first = i * STRIP_ROWS;
        s->end = s->first + STRIP_ROWS < e->height ? s->first + STRIP_ROWS : e->height;
        s->room = e->zlib.deflateBound(&none, (uLong)(e->row * (s->end - s->first))) + 64;
        s->bytes = arena_alloc(a, s->room);
    }
    e->filtered = ARENA_ARRAY(a, unsigned char *, threads);
    for (uint32_t i = 0; i < threads; i++)
        e->filtered[i] = arena_alloc_array(a, e->row, STRIP_ROWS + 1);
}

const char *image_encode_png(io_job *j, const unsigned char *pixels, uint32_t width,
                             uint32_t height, unsigned char **out, size_t *size)
{
    encoding e = {.job = j, .pixels = pixels, .width = width, .height = height};
    const char *wrong = open_library(j, &e.zlib);
    size_t room = HEAD + 13 + 2 * CHUNK + 6;
    if (wrong)
        return wrong;
    e.row = (size_t)width * BYTES + 1;
    prepare(&e);
    io_parallel(j, e.count, compress_strip, &e);
    for (uint32_t i = 0; i < e.count; i++) {
        if (e.strips[i].failed)
            return "it cannot be compressed";
        room += CHUNK + e.strips[i].size;
    }
    *out = arena_alloc(&j->memory, room);
    *size = (size_t)(put_strips(&e, put_head(&e, *out)) - *out);
    return NULL;
}

#else

const char *image_png_missing(io_job *j)
{
    (void)j;
    return "PNG was left out when this program was built (configure --without-png)";
}

const char *image_encode_png(io_job *j, const unsigned char *pixels, uint32_t width,
                             uint32_t height, unsigned char **out, size_t *size)
{
    (void)pixels, (void)width, (void)height, (void)out, (void)size;
    return image_png_missing(j);
}

#endif
