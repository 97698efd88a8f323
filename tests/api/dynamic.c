/* dynamic.c - runs that load graphs: what a host sees of it, a file that changes meanwhile, code that
 * goes with its run. */
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

static const char graph[] =
    "graph loads {\n"
    "    param style: path = \"style.pcg\"\n"
    "    rectangle() -> copy(count = 3) -> dynamic(graph = style) { in tile: Shape; out out: Shape }\n"
    "}\n";
static const char style[] = "graph style {\n"
                            "    in tile: Shape\n"
                            "    out out: Shape\n"
                            "    tile -> extrude(amount = 1m) -> out\n"
                            "}\n";

/* What the newest message said. */
typedef struct heard {
    char file[200], text[200];
    unsigned line;
    int errors;
} heard;

static void on_message(void *user, const pcg_message *m)
{
    heard *h = user;
    if (m->severity != PCG_ERROR || h->errors++)
        return;
    snprintf(h->file, sizeof h->file, "%s", m->file ? m->file : "");
    snprintf(h->text, sizeof h->text, "%s", m->text);
    h->line = m->line;
}

static void write_file(const char *path, const char *written)
{
    FILE *f = fopen(path, "w");
    CHECK(f != NULL);
    if (!f)
        return;
    fputs(written, f);
    fclose(f);
}

static pcg_status run(const pcg_program *p, const char *style_given, heard *h, size_t *faces)
{
    const pcg_run_options o = {.size = sizeof o, .message = on_message, .user = h};
    pcg_run *r = pcg_run_new(p, &o);
    pcg_status status = pcg_run_set(r, "style", style_given);
    if (status == PCG_STATUS_OK)
        status = pcg_run_execute(r);
    *faces = status == PCG_STATUS_OK ? pcg_run_face_count(r) : 0;
    pcg_run_free(r);
    return status;
}

/* Each run reads the file as it is then; what a run has said stays with it. */
static void test_runs(const pcg_program *p)
{
    heard h = {0};
    size_t faces;
    write_file("style.pcg", style);
    CHECK_INTEGER(run(p, "style.pcg", &h, &faces), PCG_STATUS_OK);
    CHECK_INTEGER(faces, 18);
    write_file("style.pcg", "graph style {\n    in tile: Shape\n    out out: Shape\n    tile -> out\n}\n");
    CHECK_INTEGER(run(p, "./style.pcg", &h, &faces), PCG_STATUS_OK);
    CHECK_INTEGER(faces, 3);
    CHECK_INTEGER(h.errors, 0);
    write_file("style.pcg", "graph style {\n    lgo()\n}\n");
    CHECK_INTEGER(run(p, "style.pcg", &h, &faces), PCG_STATUS_FAILED);
    CHECK_INTEGER(h.line, 2);
    CHECK_INTEGER(h.errors, 2);
    CHECK_TEXT(h.file, "style.pcg");
    CHECK_TEXT(h.text, "unknown procedure 'lgo'");
}

static int executable_mappings(void)
{
    FILE *maps = fopen("/proc/self/maps", "r");
    char line[1024];
    int count = 0;
    while (maps && fgets(line, sizeof line, maps)) {
        char permissions[8];
        long inode = -1;
        if (sscanf(line, "%*s %7s %*s %*s %ld", permissions, &inode) == 2)
            count += inode == 0 && !strcmp(permissions, "r-xp") && !strstr(line, "[v");
    }
    if (maps)
        fclose(maps);
    return count;
}

static void test_code_goes(const pcg_program *p)
{
    heard h = {0};
    size_t faces;
    int before = executable_mappings();
    write_file("style.pcg", style);
    for (int i = 0; i < 3; i++)
        CHECK_INTEGER(run(p, "style.pcg", &h, &faces), PCG_STATUS_OK);
    CHECK_INTEGER(executable_mappings(), before);
}

/* What the host's options named may be gone when a run needs it. */
static void test_import_paths(void)
{
    char folder[] = "parts";
    const char *paths[] = {folder, NULL};
    const pcg_compile_options options = {.size = sizeof options, .import_paths = paths};
    heard h = {0};
    size_t faces;
    mkdir("parts", 0777);
    write_file("parts/inner.pcg", "graph inner {\n    out out: Shape\n    box() -> out\n}\n");
    write_file("style.pcg", "import inner from \"inner.pcg\"\ngraph style {\n    in tile: Shape\n"
                            "    out out: Shape\n    tile -> log()\n    inner() -> out\n}\n");
    pcg_program *p = pcg_compile_text(graph, sizeof graph - 1, "loads.pcg", &options);
    memset(folder, 'x', sizeof folder - 1);
    CHECK(p != NULL);
    if (p)
        CHECK_INTEGER(run(p, "style.pcg", &h, &faces), PCG_STATUS_OK);
    CHECK_INTEGER(faces, 18);
    pcg_program_free(p);
}

int main(void)
{
    char folder[] = "/tmp/pcg-dynamic-XXXXXX";
    if (!mkdtemp(folder) || chdir(folder))
        return 1;
    pcg_program *p = pcg_compile_text(graph, sizeof graph - 1, "loads.pcg", NULL);
    CHECK(p != NULL);
    if (p) {
        test_runs(p);
        test_code_goes(p);
    }
    pcg_program_free(p);
    test_import_paths();
    remove("parts/inner.pcg");
    rmdir("parts");
    remove("style.pcg");
    return chdir("/") || rmdir(folder) ? 1 : unit_done();
}
