/* base.h - what everything may use: memory, text, lists, tables, sources, diagnostics.
 *
 * Nothing here knows the language. No function writes a global; whatever has state hangs on an
 * object that the caller holds, so that two compilations live side by side in two threads.
 */
#ifndef PCG_BASE_H
#define PCG_BASE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#if defined(__GNUC__)
#define PRINTF_LIKE(string, first) __attribute__((__format__(__printf__, string, first)))
#else
#define PRINTF_LIKE(string, first)
#endif

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* ---- arena: memory that is given back all at once -------------------------------------------- */

/* Blocks that are carved from the front. Everything a phase makes lives in one arena and goes with
 * it. When memory runs out, or `limit` is passed, `arena_alloc` jumps to `*on_failure` where that
 * is set and returns NULL where it is not. */
typedef struct arena {
    struct arena_block *block;
    char *at, *end;
    size_t used;  /* bytes taken from the system */
    size_t limit; /* bytes that may be taken; 0: no limit */
    jmp_buf *on_failure;
} arena;

/* `size` zeroed bytes, aligned to 16. */
void *arena_alloc(arena *a, size_t size);
#define ARENA_NEW(a, type)          ((type *)arena_alloc(a, sizeof(type)))
#define ARENA_ARRAY(a, type, count) ((type *)arena_alloc_array(a, sizeof(type), count))
/* As arena_alloc, for count * size bytes; an overflow of the product is a failure. */
void *arena_alloc_array(arena *a, size_t size, size_t count);
/* A NUL-terminated copy of `length` bytes. */
char *arena_copy(arena *a, const char *bytes, size_t length);
/* As printf. Not for %f, %e, %g, which follow the host's locale: text_number writes floats. NULL
 * only as arena_alloc. */
char *arena_format(arena *a, const char *format, ...) PRINTF_LIKE(2, 3);
char *arena_format_list(arena *a, const char *format, va_list arguments);
/* Makes `old` (NULL, or `old_size` bytes of this arena) at least `size` bytes long, in place where
 * it is the newest allocation and else by copying; the bytes behind the old ones are zero. As
 * arena_alloc on failure. */
void *arena_resize(arena *a, void *old, size_t old_size, size_t size);
/* Gives everything back; the arena is empty and can be used again. */
void arena_free(arena *a);

/* ---- list: a growing array ------------------------------------------------------------------- */

/* `LIST(type) name` declares one; zero-initialised is empty. Its array moves as it grows, so
 * pointers into it must not be kept meanwhile. The arena must have `on_failure` set: a list cannot
 * tell that nothing was added. */
#define LIST(type)                                                                                 \
    struct {                                                                                       \
        type *at;                                                                                  \
        uint32_t count, capacity;                                                                  \
    }
#define LIST_ADD(a, list, item)                                                                    \
    (list_reserve((a), (void **)&(list)->at, &(list)->capacity, (list)->count, sizeof *(list)->at), \
     (list)->at[(list)->count++] = (item))
void list_reserve(arena *a, void **at, uint32_t *capacity, uint32_t count, size_t size);

/* ---- text: a growing string ------------------------------------------------------------------ */

/* Always NUL-terminated once something was added; `length` does not count the NUL. Where the arena
 * has no `on_failure`, what finds no memory is left out. */
typedef struct text {
    arena *arena;
    char *at;
    size_t length, capacity;
} text;

void text_add(text *t, const char *string);
void text_add_bytes(text *t, const char *bytes, size_t length);
void text_format(text *t, const char *format, ...) PRINTF_LIKE(2, 3);
/* The string in double quotes as C and JSON both read it: escapes, and \u00XX for other
 * controls. */
void text_quote(text *t, const char *string);
/* The shortest decimal that number_read reads back as the same value: 3, 0.1, 1e-7, 2.5e+22; always
 * with '.', whatever the host's locale. inf, -inf and nan are written so; JSON has no form for
 * them. */
void text_number(text *t, double value);
/* Reads [+-] digits [. digits] [e [+-] digits], nearest double, whatever the host's locale; digits
 * may be missing on one side of the point. *end (may be NULL) is set behind it, or to s where no
 * number stands. Too large gives infinity. */
double number_read(const char *s, const char **end);

/* ---- table: from names to pointers ----------------------------------------------------------- */

/* Open addressing, keyed by NUL-terminated strings that the caller keeps alive. Iteration is in
 * order of insertion: `entries.at[0 .. entries.count - 1]`. */
typedef struct table_entry {
    const char *key;
    void *value;
} table_entry;
typedef struct table {
    LIST(table_entry) entries;
    uint32_t *slots;
    uint32_t slot_count;
} table;

/* NULL when absent. */
void *table_get(const table *t, const char *key);
/* Adds or replaces. */
void table_put(arena *a, table *t, const char *key, void *value);

/* ---- source: a file's text and its lines ----------------------------------------------------- */

typedef struct source {
    const char *path; /* as diagnostics print it */
    const char *text; /* `size` bytes and a NUL behind them; may hold NULs inside */
    size_t size;
    uint32_t *lines; /* offset at which each line begins */
    uint32_t line_count;
} source;

/* Bytes from..to-1 of a source. `source` is NULL where there is no place (a command line, say). */
typedef struct span {
    const source *source;
    uint32_t from, to;
} span;

/* A source over `text`, which must outlive it and have a NUL behind its `size` bytes. */
source *source_new(arena *a, const char *path, const char *text, size_t size);
/* Reads a whole file. NULL with errno set where that fails; EFBIG where it is longer than
 * `limit`. */
source *source_read(arena *a, const char *path, size_t limit);
/* As source_read, from an open stream (stdin, say), which stays open. */
source *source_read_stream(arena *a, const char *path, FILE *in, size_t limit);
/* Line and column of an offset, both from 1; columns count characters of UTF-8. An offset behind
 * the end counts as the end. */
void source_place(const source *s, uint32_t offset, uint32_t *line, uint32_t *column);

/* ---- diagnostics ----------------------------------------------------------------------------- */

/* The catalogue: each row DIAGNOSTIC(code, severity, "format"). Formats are lower case, have no
 * full stop, and quote names. */
typedef enum diagnostic_code {
#define DIAGNOSTIC(code, severity, format) DIAG_##code,
#include "diagnostics.def"
#undef DIAGNOSTIC
    DIAG_COUNT
} diagnostic_code;

typedef enum severity { SEVERITY_NOTE, SEVERITY_WARNING, SEVERITY_ERROR } severity;

typedef struct diagnostic_label {
    span span;
    const char *text; /* behind the carets; may be NULL */
} diagnostic_label;

typedef struct diagnostic {
    diagnostic_code code;
    severity severity;
    const char *message;
    span span;           /* the main place, with the first carets */
    const char *text;    /* what stands behind the carets, such as did you mean 'log'?; may be NULL */
    diagnostic_label second; /* a second place; span.source is NULL where there is none */
    const char *help;    /* "= help: …"; may be NULL */
} diagnostic;

typedef struct diagnostics {
    arena *arena;
    LIST(diagnostic) list;
    uint32_t errors, warnings;
    uint32_t limit; /* errors kept, and warnings; those behind it are counted only; 0: 100 */
    diagnostic spare; /* what `diagnose` returns for one that is not kept */
} diagnostics;

/* Adds a diagnostic of the catalogue; the arguments fill its format. Returns it, so that the caller
 * can set `text`, `second` and `help`, before the next one is added; never NULL. */
diagnostic *diagnose(diagnostics *d, diagnostic_code code, span place, ...);
/* So many errors are kept already that a further one is only counted: its details need not be
 * worked out. */
bool diagnostics_full(const diagnostics *d);
/* "E0102", for a code. */
const char *diagnostic_name(diagnostic_code code);
/* Prints all, by file and place, in gcc's form with carets; `colour` adds terminal colours. */
void diagnostics_print(const diagnostics *d, FILE *out, bool colour);
/* Prints one JSON object a line: severity, code, message, file, line, column, endLine, endColumn
 * (behind the last character), label, related (an array of such places), help. Absent parts are
 * left out. */
void diagnostics_print_json(const diagnostics *d, FILE *out);
/* One diagnostic in either form. */
void diagnostic_write(const diagnostic *d, bool colour, text *out);
void diagnostic_write_json(const diagnostic *d, text *out);

/* Of the `count` candidates the one nearest to `name` by edit distance, or NULL where none is near
 * enough to be meant. */
const char *nearest_name(const char *name, const char *const *candidates, size_t count);

/* ---- digests --------------------------------------------------------------------------------- */

enum { DIGEST_TEXT = 33 };
/* A hash of all that was added, where each piece began and ended included. Starts zeroed. */
typedef struct digest { uint64_t word[2]; } digest;
void digest_add(digest *d, const void *bytes, size_t count);
void digest_add_text(digest *d, const char *s); /* NULL is "" */
void digest_write(const digest *d, char out[DIGEST_TEXT]); /* 32 hexadecimal digits */

/* ---- patterns -------------------------------------------------------------------------------- */

/* A regular expression over characters of UTF-8: . [a-z] [^a-z] \d \w \s ( ) | * + ? {2} {2,} {2,5}
 * ^ $, and a backslash before what would mean something. The arenas must have `on_failure` set. */
typedef struct pattern pattern;
/* NULL where it is none; *error then says why, in static text. */
pattern *pattern_new(arena *a, const char *expression, const char **error);
/* Whether it matches the whole of `s`; needs memory while it runs. */
bool pattern_matches(arena *a, const pattern *p, const char *s);

#endif
