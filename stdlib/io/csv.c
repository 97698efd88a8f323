/* csv.c - what `report` added up, as a table: RFC 4180 with a head line, but lines end with \n. */
#include "stdlib/io/io.h"

#include <math.h>
#include <string.h>

enum { FLUSH_AT = 1 << 16 };

/* In quotes where it needs them, which are doubled inside. */
static void field(text *out, const char *value)
{
    if (!value[strcspn(value, ",\"\r\n")]) {
        text_add(out, value);
        return;
    }
    text_add(out, "\"");
    for (; *value; value++) {
        text_add_bytes(out, value, 1);
        if (*value == '"')
            text_add(out, "\"");
    }
    text_add(out, "\"");
}

/* Nothing where it is no finite number. */
static void number(text *out, double value)
{
    text_add(out, ",");
    if (isfinite(value))
        text_number(out, value + 0.0); /* no -0 */
}

static void row(text *out, const pcg_total *t)
{
    field(out, t->key);
    number(out, t->sum);
    text_format(out, ",%llu", (unsigned long long)t->count);
    number(out, t->sum / (double)t->count);
    number(out, t->least);
    number(out, t->most);
    text_add(out, "\n");
}

void io_write_csv(io_job *j, const char *path)
{
    text out = {.arena = &j->memory};
    io_output *file = output_open(j, path);
    pcg_total t;
    text_add(&out, "key,sum,count,average,least,most\n");
    for (size_t i = 0; pcg_run_total(j->run, i, &t) && !io_stopped(j); i++) {
        row(&out, &t);
        if (out.length > FLUSH_AT) {
            output_bytes(file, out.at, out.length);
            out.length = 0;
        }
    }
    output_bytes(file, out.at, out.length);
}
