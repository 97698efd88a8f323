/* result.h - what came out of a run, as the writers read it. Valid between pcg_run_execute and
 * pcg_run_free. */
#ifndef PCG_RESULT_H
#define PCG_RESULT_H

#include "base/base.h"
#include "pcg.h"
#include "shape.h"

/* True once pcg_run_execute has returned, however it went: before, there is nothing to read. */
bool result_ready(const pcg_run *r);
const pcg_module *result_module(const pcg_run *r);
uint64_t result_seed(const pcg_run *r);
/* Rounds that ran, and entities that left a port, over all nodes and whatever was loaded. */
uint64_t result_rounds(const pcg_run *r);
uint64_t result_sent(const pcg_run *r);
/* The entities that came out of output i of result_module()->outputs, in order; borrowed. */
const pcg_entities *result_entities(const pcg_run *r, uint32_t output);
/* An attribute of the main graph: its cells, those of its default while it was not written. */
const pcg_cell *result_attribute(const pcg_run *r, const pcg_entity *e,
                                 const pcg_attribute_info *a);
/* The same as JSON: numbers, strings, arrays; enumerators as strings, colours as "#rrggbb" or
 * "#rrggbbaa". */
void result_attribute_json(const pcg_run *r, const pcg_entity *e, const pcg_attribute_info *a,
                           text *out);
/* The member "path" of an entity: the output ports that it left, from the first on; the newest 256
 * where they are more, then "path_length" says how many. False: the run was not asked to remember. */
bool result_path_json(const pcg_run *r, const pcg_entity *e, text *out);
/* The properties of the run as members of an object, those of one group in an object of its own:
 * "origin":{"latitude":47.1,"longitude":9.5}. False where there is none. */
bool result_properties_json(const pcg_run *r, text *out);
/* Everything that the run (and the compilation before it) said, in order. */
size_t result_message_count(const pcg_run *r);
const pcg_message *result_message(const pcg_run *r, size_t i);
/* Sets what pcg_run_error returns; returns `status`. */
pcg_status result_fail(pcg_run *r, pcg_status status, const char *format, ...) PRINTF_LIKE(3, 4);
/* A warning about what is written (a texture that cannot be read, say), without node and place:
 * goes the way of the run's other messages. Also when memory has run out, then silently. */
void result_warn(pcg_run *r, const char *format, ...) PRINTF_LIKE(2, 3);
/* True once the run was cancelled: long writers ask now and then. */
bool result_cancelled(const pcg_run *r);
/* From now on, `found` is told of each file and folder that the graph asks for (a texture, a map), before
 * it is read, whether or not it is there; of some several times. */
void result_watch_paths(pcg_run *r, void (*found)(void *user, const char *path), void *user);
/* Whom to tell of files that are not complete yet; NULL: nobody. */
struct interrupt *result_guard(const pcg_run *r);

#endif
