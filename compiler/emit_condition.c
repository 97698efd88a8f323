/* emit_condition.c - one more expression, over a node of a program that is running already.
 *
 * The text is the program's own once more, so that the structs lie as they do in the code that
 * runs, and behind it a function over a frame of that code. Nothing else of the text is called. */
#include "emit.h"

/* The function of a form: `at` is the call of the node's round, `seen` holds an entity for each of
 * its inputs. */
static void emit_form_condition(emitter *e)
{
    const emit_condition *k = e->options->condition;
    e->node = k->node;
    e->call = "&call";
    e->entities = ARENA_ARRAY(e->arena, const char *, e->node->input_count);
    for (uint32_t i = 0; i < e->node->input_count; i++) {
        e->entities[i] = emit_name(e, "seen[%u]", i);
    }
    emit_line(e, "static int condition_%s(const pcg_call *at, pcg_entity *const *seen, int *holds)",
              e->form->tag);
    emit_block(e);
    emit_line(e, "struct %s *g = (struct %s *)at->frame;", e->form->tag, e->form->tag);
    emit_line(e, "pcg_call call = *at;");
    emit_line(e, "(void)g;");
    emit_line(e, "(void)seen;");
    e->variables = 0;
    emit_line(e, "*holds = %s;", emit_value(e, k->value).text);
    emit_line(e, "return PCG_OK;");
    emit_close(e, "\n");
    e->node = NULL;
}

static bool has_condition(const emitter *e, const form *f)
{
    return f->graph == e->options->condition->node->owner;
}

void emit_condition_functions(emitter *e)
{
    if (!e->options->condition) {
        return;
    }
    for (uint32_t i = 0; i < e->forms.count; i++) {
        e->form = e->forms.at[i];
        if (has_condition(e, e->form)) {
            emit_form_condition(e);
        }
    }
    e->form = NULL;
    emit_line(e, "int %s(pcg_u32 form, const pcg_call *at, pcg_entity *const *seen, int *holds)",
              EMIT_CONDITION_SYMBOL);
    emit_block(e);
    for (uint32_t i = 0; i < e->forms.count; i++) {
        if (has_condition(e, e->forms.at[i])) {
            emit_line(e, "if (form == %u)", i);
            emit_line(e, "    return condition_%s(at, seen, holds);", e->forms.at[i]->tag);
        }
    }
    emit_line(e, "return PCG_MISUSE;");
    emit_close(e, "\n");
}
