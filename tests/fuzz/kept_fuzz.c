/* kept_fuzz.c - any bytes as an entry of a cache: the file that it is in, and what it says came
 * out of a graph. What is believed of it must be fit for kernels. */
#include <stdlib.h>
#include <string.h>

#include "../../runtime/cache_store.h"
#include "../../runtime/program.h"
#include "../../runtime/surrogate.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What the corpus was made of. */
static const char host[] =
    "use streets\n"
    "graph seed {\n"
    "    attr name: string\n"
    "    attr sizes: list<float>\n"
    "    c: cache(graph = \"given\", where = disk, name => @name, sizes => @sizes) "
    "{ out out: Entity; out rest: Entity = *; attr name: string; attr sizes: list<float> }\n"
    "    out out: Entity\n"
    "    c.out -> out\n"
    "    c.rest -> out\n"
    "}\n"
    "graph given {\n"
    "    attr name: string\n"
    "    attr sizes: list<float>\n"
    "    out out: Entity\n"
    "    out group: Group\n"
    "    out net: StreetNetwork\n"
    "    box(width = 2m) -> map_uv_box() -> color(color = #ff0000)"
    " -> tag(name = \"wall\") -> set { assign(@name, \"wall\"); assign(@sizes, [1.0, 2.0]) }"
    " -> s: select { top; rest: all }\n"
    "    s.rest -> out\n"
    "    s.top -> copy(count = 3) -> group() -> group\n"
    "    rectangle() -> streets_from_shapes(width = 3m, name = \"Main\") -> net\n"
    "}\n";

static const pcg_declared outputs[] = {{"out", "Entity", "Entity", 1},
                                       {"rest", "Entity", "Entity", 2}};
static const pcg_declared attributes[] = {{"name", "string", NULL, 3},
                                          {"sizes", "list<float>", NULL, 4}};
static const pcg_surrogate_info info = {.kind = PCG_SURROGATE_CACHE,
                                        .outputs = outputs,
                                        .attributes = attributes,
                                        .output_count = 2,
                                        .attribute_count = 2,
                                        .rest = 1};

/* What a run would do with what came out. */
static void use(pcg_run *r, pcg_entity *e)
{
    pcg_vec3 low, high;
    pcg_entity *copy = pcg_entity_copy(r, e, 1);
    if (copy && pcg_entity_is(copy, &pcg_type_shape)) {
        pcg_shape *s = (pcg_shape *)copy;
        pcg_shape_bounds(s, &low, &high);
        pcg_shape_holes(s);
        pcg_shape_edit(r, s);
        for (uint32_t i = 0; i < s->mesh->face_count; i++)
            if (!pcg_shape_face_material(s, i)->name)
                abort();
    }
    if (copy)
        pcg_entity_drop(r, copy);
    pcg_entity_drop(r, e);
}

static void take(pcg_run *r, const uint8_t *data, size_t size)
{
    const pcg_module *m = r->module;
    pcg_queue queue = {0}, *to[] = {&queue};
    const pcg_port port = {to, 1, 0}, *ports[] = {&port, &port};
    const pcg_parameter_info *none[1];
    const pcg_attribute_info *own[] = {&m->attributes[0], &m->attributes[1]};
    pcg_u32 leads[8] = {0};
    pcg_choice k = {.module = m, .loaded = &r->own, .parameters = none, .attributes = own,
                    .outputs = leads};
    pcg_instance instance = {0};
    pcg_call call;
    if (m->output_count > COUNT_OF(leads) ||
        choice_open(&k, &info, r->frame, &m->nodes[0], 2) != PCG_OK)
        abort();
    const pcg_slot *links[] = {&k.slots[0], &k.slots[1]};
    pcg_surrogate s = {.info = &info, .outputs = ports, .links = links, .choice = &k};
    pcg_begin(&call, r->frame, &m->nodes[0], &instance);
    pcg_unpacker u = {.run = r, .at = (const char *)data, .end = (const char *)data + size,
                      .module = m, .cell = -1};
    outcome_take(&u, &call, &s, true);
    unpacker_close(&u);
    if (u.failed && PCG_READY(queue))
        abort();
    while (PCG_READY(queue))
        use(r, PCG_TAKE(queue));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static pcg_program *p;
    const pcg_run_options o = {.size = sizeof o, .max_memory = 256 << 20, .max_entities = 1 << 20};
    const digest key = {{1, 2}};
    if (!p)
        p = pcg_compile_text(host, sizeof host - 1, "seed.pcg", NULL);
    pcg_run *r = p ? pcg_run_new(p, &o) : NULL;
    if (!r)
        abort();
    if (size > CACHE_HEAD_BYTES && cache_file_is_whole(&key, (const char *)data, size))
        take(r, data + CACHE_HEAD_BYTES, size - CACHE_HEAD_BYTES);
    else
        take(r, data, size);
    pcg_run_free(r);
    return 0;
}
