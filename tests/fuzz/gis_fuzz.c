/* gis_fuzz.c - any text as a condition on features, as the value of a field, as tags, and as a
 * GeoJSON file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../stdlib/gis/gis.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Fields with long names have values: their own names. */
static const char *look_up(void *context, const char *field)
{
    (void)context;
    return strlen(field) > 2 ? field : NULL;
}

static void try_condition(const char *condition)
{
    const char *error;
    size_t at, size = gis_where_size(condition);
    void *memory = size ? malloc(size) : NULL;
    const gis_where *w = memory ? gis_where_parse(condition, memory, &error, &at) : NULL;
    if (w)
        gis_where_holds(w, look_up, NULL);
    else if (memory && (!error || at > strlen(condition)))
        abort();
    free(memory);
}

/* What is no object is found in order, each once. */
static void find_elements(const uint8_t *data, size_t size)
{
    gis_elements place = {.index = 0};
    uint64_t next = 0;
    for (size_t i = 0; i < size; i++) {
        if (!gis_element_is_other(&place, (char)data[i]))
            continue;
        if (place.index < next || place.depth > i + 1)
            abort();
        next = place.in_features || place.depth > 1 ? place.index + 1 : next;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double number;
    char *bytes = malloc(size + 1), *out = malloc(size + 1);
    pcg_cell cells[4];
    if (bytes && out) {
        if (size)
            memcpy(bytes, data, size);
        bytes[size] = '\0';
        try_condition(bytes);
        for (int kind = PCG_BOOL; kind <= PCG_SECONDS; kind++)
            gis_value_read(bytes, kind, cells);
        gis_tags_find(bytes, "key", out);
        if (gis_number_read(bytes, &number) && !isfinite(number))
            abort();
        find_elements(data, size);
    }
    free(bytes);
    free(out);
    return 0;
}
