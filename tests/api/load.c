/* load.c - programs from shared objects: a good one, and each way in which a file can be none. */
#include <stdlib.h>
#include <sys/stat.h>

#include "tests/unit/unit.h"
#include "runtime/abi.h"
#include "runtime/pcg.h"

#define TEXT(number) #number
#define NUMBER(macro) TEXT(macro)

static const char module_text[] =
    "static int start(pcg_frame *f) { (void)f; return PCG_OK; }\n"
    "static int run(pcg_frame *f) { (void)f; return PCG_OK; }\n"
    "const pcg_module pcg_compiled = {.abi = RIGHT, .size = sizeof(pcg_module), .name = "
    "\"empty\", .version = \"1\",\n"
    "    .frame_size = sizeof(pcg_frame), .start = start, .run = run};\n";

static char said[1000];

static void hear(void *user, const pcg_message *m)
{
    (void)user;
    snprintf(said, sizeof said, "%s", m->rendered);
}

static pcg_program *load(const char *path)
{
    const pcg_compile_options options = {.size = sizeof options, .message = hear};
    said[0] = '\0';
    return pcg_program_load(path, &options);
}

static void write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    CHECK(f && fputs(text, f) >= 0 && fclose(f) == 0);
}

/* Builds name.so in the working folder, with `text` behind the head that emitted C has. */
static void build(const char *name, const char *text, const char *flags)
{
    const char *root = getenv("ROOT"), *cc = getenv("CC");
    char path[100], command[2000];
    snprintf(path, sizeof path, "%s.c", name);
    write_file(path, text);
    snprintf(command, sizeof command,
             "%s -std=c11 -shared -fPIC %s -include '%s/runtime/abi.h' -o %s.so %s", cc ? cc : "cc",
             flags, root ? root : ".", name, path);
    CHECK_NUMBER(system(command), 0);
}

static void a_good_one(void)
{
    build("good", module_text, "-DRIGHT=PCG_ABI");
    pcg_program *p = load("good.so"), *again = load("./good.so");
    CHECK_TEXT(said, "");
    CHECK(p && again);
    CHECK_TEXT(pcg_program_name(p), "empty");
    CHECK_TEXT(pcg_program_document(p), "");
    pcg_program_free(again);
    pcg_run *r = pcg_run_new(p, NULL);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_set(r, "x", "1"), PCG_STATUS_MISUSE);
    pcg_run_free(r);
    pcg_program_free(p);
}

static void refuses(const char *path, const char *why)
{
    CHECK(load(path) == NULL);
    CHECK_PART(said, why);
    CHECK(pcg_program_load(path, NULL) == NULL);
}

static void each_bad_one(void)
{
    static const char needs[] = "int pcg_geometry_nothing(void);\nint use(void);\nint use(void) { "
                                "return pcg_geometry_nothing(); }\n";
    static const char needs_function[] =
        "int pcg_core_fn_min_int_string(void);\nint use(void);\nint use(void) { return "
        "pcg_core_fn_min_int_string(); }\n";
    refuses("absent.so", "error: cannot read 'absent.so': No such file or directory\n");
    refuses("", "error: cannot read '': ");
    mkdir("folder.so", 0700);
    refuses("folder.so", "error: cannot read 'folder.so': it is no file\n");
    write_file("text.so", "graph house { }\n");
    refuses("text.so", "error: cannot load 'text.so': ");
    write_file("nothing.so", "");
    refuses("nothing.so", "error: cannot load 'nothing.so': ");
    write_file("head.so", "\177ELF\002\001\001");
    refuses("head.so", "error: cannot load 'head.so': ");
    build("other", "int x;\n", "");
    refuses("other.so", "error: 'other.so' is no graph that pcgc made\n");
    build("old", module_text, "-DRIGHT=4242");
    refuses("old.so", "error: 'old.so' was made for interface 4242 of the runtime, this one has "
                      "interface " NUMBER(PCG_ABI) ": compile it again\n");
    build("lacking", needs, "");
    refuses("lacking.so", "error: 'lacking.so' needs procedure 'geometry.nothing', which this "
                          "runtime does not have\n");
    build("lacking_function", needs_function, "");
    refuses("lacking_function.so",
            "error: 'lacking_function.so' needs function 'core.min_int_string', which this runtime "
            "does not have\n");
}

int main(void)
{
    a_good_one();
    each_bad_one();
    return unit_done();
}
