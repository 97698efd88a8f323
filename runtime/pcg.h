/* pcg.h - the C API of pcgc: compile a graph or load a compiled one, run it, read what it made.
 *
 *     pcg_program *house = pcg_program_load("house.so", NULL);
 *     pcg_run *run = pcg_run_new(house, NULL);
 *     pcg_run_set(run, "height", "12m");
 *     if (pcg_run_execute(run) == 0)
 *         printf("%zu polygons\n", pcg_run_face_count(run));
 *     pcg_run_free(run);
 *     pcg_program_free(house);
 *
 * Handles are opaque. Structs that callers fill begin with their own size, so that they can grow: set them with
 * `= {.size = sizeof x}`. Nothing here writes to stdout or stderr, exits, or changes the locale. Callbacks
 * come on the thread that made the call. A program can be run by many runs at once, each on a thread of its
 * own; one run belongs to one thread, except for pcg_run_cancel. Strings and arrays that are handed out belong to
 * their run (or program) and live as long as it.
 *
 * Units: metres, degrees, seconds; the world is right-handed with z up; colours are sRGB in 0 … 1.
 */
#ifndef PCG_H
#define PCG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PCG_VERSION "0.1.0"

#if defined(__GNUC__)
#define PCG_API __attribute__((visibility("default")))
#else
#define PCG_API
#endif

/* What pcg_run_execute and the setters return. */
typedef enum pcg_status {
    PCG_STATUS_OK = 0,
    PCG_STATUS_FAILED = 1,    /* the graph ran and failed: see the messages */
    PCG_STATUS_LIMIT = 2,     /* a limit was hit */
    PCG_STATUS_CANCELLED = 3, /* pcg_run_cancel was called */
    PCG_STATUS_MISUSE = 4     /* unknown name, wrong type, a call out of turn */
} pcg_status;

typedef struct pcg_program pcg_program;
typedef struct pcg_run pcg_run;
struct pcg_module;

/* PCG_VERSION of the library that runs, which is not always that of the header. */
PCG_API const char *pcg_version(void);

/* ---- messages -------------------------------------------------------------------------------- */

typedef enum pcg_severity { PCG_NOTE, PCG_WARNING, PCG_ERROR } pcg_severity;

typedef struct pcg_message {
    pcg_severity severity;
    const char *code;      /* "E0102"; "" for what `log` prints */
    const char *text;      /* one line, without place or code */
    const char *file;      /* NULL where there is no place */
    uint32_t line, column; /* from 1 */
    const char *node;      /* at run time: the node; else NULL */
    uint64_t round;        /* at run time: its round, from 1; else 0 */
    const char *rendered;  /* the whole message as pcgc prints it, carets included */
} pcg_message;

/* `m` and its strings are there for the call only. */
typedef void pcg_message_function(void *user, const pcg_message *m);

/* ---- programs -------------------------------------------------------------------------------- */

typedef struct pcg_compile_options {
    size_t size;
    const char *graph;                 /* which graph of the file; NULL: the one named like it, or the only one */
    const char *const *import_paths;   /* NULL-terminated; where imports are looked up beside the file's folder */
    pcg_message_function *message;     /* errors and warnings; may be NULL */
    void *user;
    const char *const *library_paths;  /* NULL-terminated; folders where `use` looks for libraries, beside the graph's
                                        * own, PCG_LIBRARY_PATH and where the runtime is installed */
    bool observed;                     /* runs can be given to pcg_run_observe; they take longer */
} pcg_compile_options;

/* In libpcg (the compiler). NULL when there were errors (the messages say which). */
PCG_API pcg_program *pcg_compile_file(const char *path, const pcg_compile_options *options);
/* `name` stands for the path in messages and is where imports and assets are looked up beside. */
PCG_API pcg_program *pcg_compile_text(const char *text, size_t length, const char *name,
                                      const pcg_compile_options *options);

/* In the runtime: a .so that pcgc made; and a graph that is linked in from emitted C. */
PCG_API pcg_program *pcg_program_load(const char *path, const pcg_compile_options *options);
PCG_API pcg_program *pcg_program_of(const struct pcg_module *module);
/* As pcg_program_of, where the graph uses libraries that are not built in: `options` says where they
 * are, and who is told why when the result is NULL. */
PCG_API pcg_program *pcg_program_link(const struct pcg_module *module, const pcg_compile_options *options);
PCG_API void pcg_program_free(pcg_program *p); /* when no run of it is left; NULL is allowed */

typedef struct pcg_parameter {
    const char *name, *document, *type, *initial;
    bool hidden;
} pcg_parameter;
typedef struct pcg_gate {
    const char *name, *document, *type;
    bool collective;
} pcg_gate;

PCG_API const char *pcg_program_name(const pcg_program *p);
PCG_API const char *pcg_program_document(const pcg_program *p);
PCG_API size_t pcg_program_parameter_count(const pcg_program *p);
PCG_API bool pcg_program_parameter(const pcg_program *p, size_t i, pcg_parameter *out);
/* What a parameter may be, for dials and menus. The range that it has to be in, in its base unit:
 * false where there is none. The words that it has to be one of, separated by \n: those of its
 * enumeration, or of `one of`; NULL where any will do. pcg_run_set checks both, and the rest. */
PCG_API bool pcg_program_parameter_range(const pcg_program *p, size_t i, double *low, double *high);
PCG_API const char *pcg_program_parameter_choices(const pcg_program *p, size_t i);
PCG_API size_t pcg_program_input_count(const pcg_program *p);
PCG_API bool pcg_program_input(const pcg_program *p, size_t i, pcg_gate *out);
PCG_API size_t pcg_program_output_count(const pcg_program *p); /* gates, then leaf ports */
PCG_API bool pcg_program_output(const pcg_program *p, size_t i, pcg_gate *out);

/* ---- runs ------------------------------------------------------------------------------------ */

typedef struct pcg_progress {
    size_t size;
    const char *node;        /* that runs now */
    uint64_t rounds, entities;
    size_t memory;           /* bytes */
    double seconds;
} pcg_progress;

typedef struct pcg_run_options {
    size_t size;
    uint64_t seed;
    bool strict;             /* a bad entity stops the run */
    /* Limits; 0: the default. */
    uint64_t max_rounds;     /* 1,000,000,000 */
    uint64_t max_entities;   /* alive at one time; 100,000,000 */
    uint32_t max_depth;      /* of encapsulation; 1,000 */
    size_t max_memory;       /* bytes; 16 GiB, or 3/4 of the machine's */
    double max_seconds;      /* none */
    pcg_message_function *message; /* warnings, errors, what `log` prints, as they come; may be NULL */
    /* Called about ten times a second; a result other than 0 cancels. May be NULL. */
    int (*progress)(void *user, const pcg_progress *p);
    void *user;
    bool provenance;         /* entities remember the ports that they left: "path" in .json with entities */
    uint32_t threads;        /* at most, for what `parallel` runs; 0: as many as there are processors */
    bool no_cache;           /* what `cache` may have kept is made again, and nothing is kept */
    size_t max_cache;        /* bytes that it may keep in memory, and on disk; 0: 256 MiB, and 1 GiB */
} pcg_run_options;

/* A run of a program, not started. NULL options: the defaults. NULL when memory has run out. */
PCG_API pcg_run *pcg_run_new(const pcg_program *p, const pcg_run_options *options);
PCG_API void pcg_run_free(pcg_run *r); /* NULL is allowed */

/* Parameters, before pcg_run_execute. pcg_run_set reads the value as the language writes it:
 * 12m, true, y, "text" (quotes may be left out), #ff8800, [1, 2, 3]. PCG_STATUS_MISUSE, and
 * pcg_run_error says why, where the name is unknown, the type does not fit or a constraint does
 * not hold. */
PCG_API pcg_status pcg_run_set(pcg_run *r, const char *name, const char *value);
PCG_API pcg_status pcg_run_set_bool(pcg_run *r, const char *name, bool value);
PCG_API pcg_status pcg_run_set_int(pcg_run *r, const char *name, int64_t value);
PCG_API pcg_status pcg_run_set_float(pcg_run *r, const char *name, double value);
PCG_API pcg_status pcg_run_set_string(pcg_run *r, const char *name, const char *value);

/* Feeds an input gate one shape: `face_count` polygons over points of 3 doubles; face i has
 * counts[i] corners, whose points are the next of `corners`. What is fed takes the place of the
 * gate's stand-in. */
PCG_API pcg_status pcg_run_input_mesh(pcg_run *r, const char *gate, const double *points, size_t point_count,
                                      const uint32_t *counts, size_t face_count, const uint32_t *corners);


struct pcg_mesh_view;
struct pcg_material_view;
/* The same with all that a shape can have. `mesh` is filled as pcg_run_mesh fills it, so that what
 * one run made can be fed to another: counts, points, face_loops, loop_corners, corner_points; and
 * edges, normals, uvs (NULL: none) and face_materials, which are numbers of `materials` (NULL: all
 * faces have the first one, or the default where there is none). The rest is not read. Everything
 * is copied. */
PCG_API pcg_status pcg_run_input_shape(pcg_run *r, const char *gate, const struct pcg_mesh_view *mesh,
                                       const struct pcg_material_view *materials, size_t material_count);
/* Sets an attribute of the graph in the shape that was fed last: read from text as pcg_run_set
 * does, or a number (of an int, float or unit). */
PCG_API pcg_status pcg_run_input_attribute(pcg_run *r, const char *name, const char *value);
PCG_API pcg_status pcg_run_input_attribute_float(pcg_run *r, const char *name, double value);

/* Runs it, once. */
PCG_API pcg_status pcg_run_execute(pcg_run *r);
/* From any thread, at any time while the run lives: execute returns PCG_STATUS_CANCELLED within
 * 50 ms. pcg_run_free then waits for what a library could not be stopped in, such as opening a map. */
PCG_API void pcg_run_cancel(pcg_run *r);
/* What went wrong last, as one line; "" when nothing did. */
PCG_API const char *pcg_run_error(const pcg_run *r);
/* All that was said so far, the warnings of the compilation first: for hosts that took no
 * callback. NULL beyond the last. */
PCG_API size_t pcg_run_message_count(const pcg_run *r);
PCG_API const pcg_message *pcg_run_message(const pcg_run *r, size_t i);

/* ---- watching a run -------------------------------------------------------------------------- */

typedef enum pcg_event_kind {
    PCG_EVENT_ROUND,         /* a round has its entities and parameters, and is about to run */
    PCG_EVENT_SENT,          /* it has sent an entity */
    PCG_EVENT_END            /* it is done; a round of an encapsulated graph holds those of its nodes */
} pcg_event_kind;

typedef struct pcg_event {
    size_t size;
    pcg_event_kind kind;
    const char *node, *procedure, *graph, *file; /* of the round; valid as long as the program */
    uint32_t line, column;
    uint64_t round;          /* of that node, from 1 */
    uint32_t depth;          /* of encapsulation; 0: the main graph */
    size_t memory;           /* bytes that the run has taken so far */
    size_t input_count, parameter_count; /* of PCG_EVENT_ROUND: for the functions below */
    const char *port;        /* of PCG_EVENT_SENT, and so the rest */
    uint64_t entity;         /* entities have numbers from 1, in the order in which they are made */
    uint64_t original;       /* it is a copy of this one, made for a further edge; 0: it is none */
    bool dropped;            /* nothing takes it */
} pcg_event;

/* `e` is there for the call only. The observer must not change the run, but may cancel it. */
typedef void pcg_observer(void *user, pcg_run *r, const pcg_event *e);
/* Has every round told to an observer; before pcg_run_execute. Results are the same as without.
 * PCG_STATUS_MISUSE where the program was not compiled with `observed`. */
PCG_API pcg_status pcg_run_observe(pcg_run *r, pcg_observer *observer, void *user);

/* Within the observer, while it is told a PCG_EVENT_ROUND. False, and 0, beyond the last. */
typedef struct pcg_event_input { const char *name; size_t count; } pcg_event_input;
typedef struct pcg_event_parameter {
    const char *name, *type;
    const char *value;       /* as the language writes it; until the next one is asked for */
} pcg_event_parameter;
PCG_API bool pcg_run_event_input(pcg_run *r, size_t input, pcg_event_input *out);
PCG_API uint64_t pcg_run_event_entity(pcg_run *r, size_t input, size_t entity);
PCG_API bool pcg_run_event_parameter(pcg_run *r, size_t parameter, pcg_event_parameter *out);
/* The queues of the graph that the round's node stands in, without what this round has taken. */
typedef struct pcg_event_queue {
    const char *node, *port; /* that it waits at */
    size_t count;
    bool leaf;               /* it is what has come out of that port, which leads nowhere */
} pcg_event_queue;
PCG_API bool pcg_run_event_queue(pcg_run *r, size_t queue, pcg_event_queue *out);
PCG_API uint64_t pcg_run_event_waiting(pcg_run *r, size_t queue, size_t entity);

/* ---- results, once it was executed ----------------------------------------------------------- */

/* How many entities came out of output i (as pcg_program_output numbers them). */
PCG_API size_t pcg_run_output_count(const pcg_run *r, size_t output);
/* The node that made an entity, and the type that it is of ("Shape"); NULL where there is no such
 * entity, and "" for the node of one that the host fed. */
PCG_API const char *pcg_run_entity_node(const pcg_run *r, size_t output, size_t entity);
PCG_API const char *pcg_run_entity_type(const pcg_run *r, size_t output, size_t entity);
/* Over all outputs. */
PCG_API size_t pcg_run_face_count(const pcg_run *r);
PCG_API size_t pcg_run_vertex_count(const pcg_run *r);

/* One entity's geometry as flat arrays: made when first asked for, kept until the run is freed. */
typedef struct pcg_mesh_view {
    size_t size;
    size_t point_count, face_count, loop_count, corner_count, triangle_count;
    const double *points;          /* 3 a point: world, metres */
    const uint32_t *face_loops;    /* face_count + 1: loops of face f; the first is its outline, the others holes */
    const uint32_t *loop_corners;  /* loop_count + 1 */
    const uint32_t *corner_points; /* a point for each corner */
    const float *normals;          /* 3 a corner, world */
    const float *uvs;              /* 2 a corner; NULL where it has none */
    const uint32_t *triangles;     /* 3 corners each */
    const uint32_t *triangle_faces; /* the face that each triangle is of */
    const uint32_t *face_materials; /* for pcg_run_material */
    const uint32_t *face_entities; /* of pcg_run_output_mesh: the entity of each face; else NULL */
    size_t edge_count;
    const uint32_t *edges;         /* 2 points each: those of no face (lines) */
} pcg_mesh_view;
PCG_API pcg_status pcg_run_mesh(pcg_run *r, size_t output, size_t entity, pcg_mesh_view *out);
/* All shapes of an output as one mesh, in their order: one call where there are a hundred thousand.
 * face_entities says whose each face is. uvs are (0, 0) where a shape has none, and NULL where
 * none has. PCG_STATUS_LIMIT where it does not fit into 32-bit numbers, or into memory. */
PCG_API pcg_status pcg_run_output_mesh(pcg_run *r, size_t output, pcg_mesh_view *out);

typedef struct pcg_material_view {
    size_t size;
    const char *name;
    double color[4];      /* sRGB, alpha */
    const char *texture;  /* path of an image, or NULL */
    double metallic, roughness;
    bool two_sided;       /* seen from behind, too */
} pcg_material_view;
PCG_API size_t pcg_run_material_count(const pcg_run *r);
PCG_API pcg_status pcg_run_material(const pcg_run *r, uint32_t material, pcg_material_view *out);

/* An attribute of an entity as text, as the language writes it; NULL where the graph has no such
 * attribute. */
PCG_API const char *pcg_run_attribute(pcg_run *r, size_t output, size_t entity, const char *name);
PCG_API pcg_status pcg_run_attribute_float(pcg_run *r, size_t output, size_t entity, const char *name, double *out);
/* The same of all entities of an output: `width` numbers for each (1; 2 for vec2, 3 for vec3, 4 for
 * vec4, quaternion and color), one behind the other into `out`, which has room for
 * pcg_run_output_count times width. */
PCG_API pcg_status pcg_run_attribute_floats(pcg_run *r, size_t output, const char *name, size_t width, double *out);
PCG_API size_t pcg_program_attribute_count(const pcg_program *p);
PCG_API const char *pcg_program_attribute_name(const pcg_program *p, size_t i);
PCG_API const char *pcg_program_attribute_type(const pcg_program *p, size_t i); /* int, color */

/* What a procedure said of the result as a whole; read_map tells where on Earth the origin is:
 * origin.latitude, origin.longitude (degrees) and origin.crs (for PROJ). The value as text, NULL
 * where there is no such property. */
PCG_API size_t pcg_run_property_count(const pcg_run *r);
PCG_API const char *pcg_run_property_key(const pcg_run *r, size_t i); /* NULL beyond the last */
PCG_API const char *pcg_run_property(pcg_run *r, const char *key);
PCG_API pcg_status pcg_run_property_float(pcg_run *r, const char *key, double *out);

/* What `report` added up, in order of the keys. False beyond the last. */
typedef struct pcg_total {
    const char *key;          /* floor.area; valid as long as the run */
    double sum, least, most;
    uint64_t count;           /* of the amounts that were added up */
} pcg_total;
PCG_API size_t pcg_run_total_count(const pcg_run *r);
PCG_API bool pcg_run_total(const pcg_run *r, size_t i, pcg_total *out);

typedef struct pcg_timing {
    const char *name;         /* of a pass, or what was written */
    double seconds;
} pcg_timing;

/* Writes everything that came out to a file: .glb, .obj (with .mtl), .png (a picture), .json (as
 * run --json prints), .csv (what `report` added up). `format` NULL: by the extension. The file appears whole or not at all. */
typedef struct pcg_write_options {
    size_t size;
    uint32_t width, height;   /* of a picture; 0: 1280 by 960 */
    bool entities;            /* json: list every entity; glb: a node for each, however many */
    uint32_t threads;         /* that draw a picture; 0: one a processor. No byte depends on it */
    const char *view;         /* of a picture: auto (or NULL) bird iso top front back left right */
    const char *look_at;      /* "x,y,z" or "x,y,z,radius" in metres: what is in its middle, and
                               * how much around it is seen; NULL: all */
    const char *from;         /* "x,y,z": where the camera stands, instead of a view; NULL */
    const pcg_timing *timings; /* json: what took how long, as "time"; NULL: left out */
    size_t timing_count;
} pcg_write_options;
PCG_API pcg_status pcg_run_write(pcg_run *r, const char *path, const char *format, const pcg_write_options *options);

/* The main function of an executable that pcgc makes: -p name=value, --seed, -o, --json, --help. */
PCG_API int pcg_main(const struct pcg_module *module, int argc, char **argv);

#ifdef __cplusplus
}
#endif
#endif
