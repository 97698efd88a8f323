/* emit_header.c - the header beside an emitted .c: how a program that has the graph built in
 * gets at it. */
#include "emit.h"

void emit_header(compilation *c, const program *p, text *out)
{
    (void)c;
    const char *name = p->main->symbol;
    text_format(out, "/* %s.h - the graph %s, compiled to C: link %s.c and libpcgrt.\n", name, name,
                name);
    text_add(out, " *\n");
    text_format(out, " *     pcg_program *program = pcg_program_of(&pcg_graph_%s);\n", name);
    text_add(out, " *     pcg_run *run = pcg_run_new(program, NULL);\n");
    text_add(out, " *     if (pcg_run_execute(run) == PCG_STATUS_OK)\n");
    text_format(out, " *         pcg_run_write(run, \"%s.glb\", NULL, NULL);\n", name);
    text_add(out, " *     pcg_run_free(run);\n");
    text_add(out, " *     pcg_program_free(program);\n");
    text_add(out, " */\n");
    text_format(out, "#ifndef PCG_GRAPH_%s_H\n#define PCG_GRAPH_%s_H\n\n", name, name);
    text_add(out, "#include <pcg.h>\n\n");
    text_add(out, "#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n");
    text_format(out, "extern const struct pcg_module pcg_graph_%s;\n\n", name);
    text_add(out, "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}
