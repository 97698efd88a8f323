/*pcg
/// Changes a parameter of the graph for the nodes that run later.
///
/// What depends on the parameter follows: expressions, constants, what encapsulated graphs are given from then on. Defaults of
/// attributes and of other parameters, and which edges a condition opens, are decided when the graph starts and stay.
/// The change holds for the rest of the run, in this graph where it stands; what a graph around it hands in again
/// replaces it. The value must be of the parameter's type, or text that holds one, and meet its constraints. The
/// parameter's name is checked when compiling if it is known then.
procedure set_parameter<T: Entity>(in: T) -> (out: T) [effect, one_to_one, reflects] {
    category "reflection"
    synonyms "parameter", "global", "variable", "mutate", "assign", "change"
    param parameter: string /// Its name.
    param value: any        /// What it becomes; evaluated for each entity.
    example rectangle(width = 2m, height = 3m)
        -> set_parameter(parameter = "tall", value = 5m)
        -> e: extrude(amount = tall) expect e.out.volume = 30
}
*/
#include "set_parameter.h"
#include <string.h>
#include "reflection.h"
#include "runtime/constraint.h"

static int set_fits(const pcg_parameter_info *p, const pcg_any *value)
{
    return p->kind == value->kind || (value_is_float(p->kind) && value->kind == PCG_FLOAT) ||
           (p->kind == PCG_PATH && value->kind == PCG_STRING);
}

/* The value as one of the parameter's type. Status. */
static int set_convert(pcg_call *call, const pcg_parameter_info *p, const pcg_any *value,
                       pcg_cell *to)
{
    char why[VALUE_WHY_BYTES];
    const value_type type = core_parameter_type(p);
    if (value_is_float(p->kind) && value->kind == PCG_INT) {
        to->f = (double)value->cell[0].i;
        return PCG_OK;
    }
    if (set_fits(p, value)) {
        memcpy(to, value->cell, value_width(p->kind) * sizeof *to);
        return PCG_OK;
    }
    if (p->kind == PCG_STRING) {
        to->s = pcg_text(call->run, value->cell, value->kind, 0, 0);
        return PCG_OK;
    }
    if (value->kind != PCG_STRING) {
        return pcg_fail(call, "parameter '%s' is of type %s, the value of type %s", p->name,
                        p->type, value_kind_name(value->kind));
    }
    if (!value_read(call->run, &type, value->cell[0].s, to, why)) {
        return pcg_fail(call, "parameter '%s' %s", p->name, why);
    }
    return PCG_OK;
}

static int set_constrain(pcg_call *call, const pcg_parameter_info *p, const pcg_cell *value)
{
    for (pcg_u32 i = 0; i < p->constraint_count; i++) {
        PCG_TRY(pcg_constrain(call, p->name, &p->constraints[i], value, p->kind, p->element,
                              p->enumerators));
    }
    return PCG_OK;
}

int pcg_core_set_parameter(pcg_call *call, struct pcg_core_set_parameter *node)
{
    const pcg_parameter_info *p = core_parameter(call, node->parameter);
    pcg_cell value[4];
    if (!p) {
        return PCG_FAILED;
    }
    PCG_TRY(set_convert(call, p, &node->value, value));
    PCG_TRY(set_constrain(call, p, value));
    memcpy(core_parameter_cells(call, p), value, value_width(p->kind) * sizeof value[0]);
    ((char *)call->frame)[p->given] = 1;
    PCG_TRY(call->frame->about->change(call->frame));
    return pcg_emit(call, node->out, node->in);
}
