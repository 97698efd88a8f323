/*pcg
/// Writes what parameters of the graph are now, found by their names, to attributes.
///
/// A parameter whose name is known stands in expressions as it is; this is for names that come from elsewhere. A
/// name is checked when compiling if it is known then.
procedure get_parameter<T: Entity>(in: T) -> (out: T) [stateful, one_to_one, reflects] {
    category "reflection"
    synonyms "parameter", "global", "variable", "read", "reflect"
    /// One parameter.
    augment read(
        parameter: string, /// Its name; evaluated for each entity.
        to: attribute      /// Of the parameter's type, or a string, which takes any.
    )
    example rectangle(width = 2m, height = 3m)
        -> set_parameter(parameter = "level", value = 4)
        -> get_parameter { read(parameter = "level", to = @n) }
        -> c: condition(@n == 4) expect c.yes.count = 1
}
*/
#include "get_parameter.h"
#include "reflection.h"

static int get_read(pcg_call *call, const struct pcg_core_get_parameter *node,
                    const struct pcg_core_get_parameter_item *item)
{
    const pcg_slot *to = &item->read.to;
    const pcg_parameter_info *p = core_parameter(call, item->read.parameter);
    if (!p) {
        return PCG_FAILED;
    }
    const pcg_cell *value = core_parameter_cells(call, p);
    if (to->kind == p->kind && (p->kind != PCG_LIST || to->element == p->element)) {
        pcg_set_cells(call->run, node->in, to, value);
    } else if (to->kind == PCG_STRING) {
        const char *written = pcg_text(call->run, value, p->kind, p->element, p->enumerators);
        pcg_set_string(call->run, node->in, to, written);
    } else {
        return pcg_fail(call, "parameter '%s' is of type %s, the attribute of type %s", p->name,
                        p->type, value_kind_name(to->kind));
    }
    return PCG_OK;
}

int pcg_core_get_parameter(pcg_call *call, struct pcg_core_get_parameter *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        PCG_TRY(get_read(call, node, &node->items[i]));
    }
    return pcg_emit(call, node->out, node->in);
}
