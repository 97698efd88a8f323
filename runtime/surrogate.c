/* surrogate.c - runs what a surrogate has chosen: as an encapsulated graph, whose frame is made when it
 * is first chosen and kept for the run. */
#include "surrogate.h"

#include <string.h>

#include "pool.h"
#include "value.h"

/* ---- frames --------------------------------------------------------------------------------- */

/* Its gates count as fed, so that no stand-in runs. */
static void wire_inputs(const pcg_surrogate_info *info, pcg_choice *k)
{
    for (pcg_u32 i = 0; i < k->module->input_count; i++) {
        const pcg_port_info *p = &k->module->inputs[i];
        *(pcg_u8 *)choice_at(k, p->given) = 1;
        for (pcg_u32 d = 0; d < info->input_count; d++)
            if (!strcmp(info->inputs[d].name, p->name))
                k->inputs[d] = choice_at(k, p->queue);
    }
}

static void wire_attributes(const pcg_surrogate_info *info, pcg_choice *k)
{
    for (pcg_u32 i = 0; i < info->attribute_count; i++) {
        const pcg_attribute_info *a = k->attributes[i];
        k->slots[i] = (pcg_slot){.cell = (int)(k->frame->base + a->cell),
                                 .kind = a->kind,
                                 .initial = choice_at(k, a->initial),
                                 .element = a->element};
    }
}

int choice_open(pcg_choice *k, const pcg_surrogate_info *info, pcg_frame *parent,
                const pcg_node *node, pcg_u32 cells)
{
    pcg_run *r = parent->run;
    k->inputs = run_alloc_array(r, info->input_count, sizeof *k->inputs);
    k->slots = run_alloc_array(r, info->attribute_count, sizeof *k->slots);
    k->frame = pcg_frame_new(parent, node, k->module->frame_size, cells);
    if (!k->inputs || !k->slots || !k->frame)
        return r->status;
    loaded_take(k->frame, k->loaded);
    wire_inputs(info, k);
    wire_attributes(info, k);
    k->below = k->frame->base;
    k->origin = -1;
    k->stale = true;
    return PCG_OK;
}

/* Between the cells of the graph around a cache and those of its own is the one for origins. */
static int make_frame(pcg_call *c, const pcg_surrogate_info *info, pcg_choice *k)
{
    bool kept = info->kind == PCG_SURROGATE_CACHE;
    PCG_TRY(choice_open(k, info, c->frame, c->node, info->cells + kept));
    if (kept) {
        k->below--;
        k->origin = (int)k->below;
    }
    return PCG_OK;
}

/* ---- choosing ------------------------------------------------------------------------------- */

/* One graph has one frame, whatever name it is chosen by. */
static pcg_choice *chosen_before(const pcg_choices *all, const pcg_choice *like)
{
    for (pcg_choice *k = all->all; k; k = k->next)
        if (k->module == like->module)
            return k;
    return NULL;
}

/* What knows of other executions is left to the main run, and is not run in threads there. */
static int note_tied(pcg_call *c, const pcg_surrogate *s, const pcg_choice *k)
{
    pcg_run *r = c->run;
    const pcg_module *m = k->module;
    if (r->is_worker)
        return pcg_fail(c, "graph '%s' is not for threads: %s", m->name, m->tied);
    if (s->info->kind == PCG_SURROGATE_PARALLEL)
        message_tell(r, PCG_NOTE, MESSAGE_PLAIN, c->node, 0,
                     pcg_format(r, "graph '%s' is run for one entity after another: %s", m->name,
                                m->tied));
    return PCG_OK;
}

static int choose_new(pcg_call *c, pcg_surrogate *s, const char *name, pcg_choice **to)
{
    pcg_choice found = {.name = pcg_string(c->run, name)};
    PCG_TRY(loading_find(c, s->info, name, &found));
    *to = chosen_before(s->choices, &found);
    if (*to)
        return PCG_OK;
    pcg_choice *k = run_alloc_zeroed(c->run, sizeof *k);
    if (!k)
        return c->run->status;
    *k = found;
    PCG_TRY(surrogate_fit(c, s->info, k));
    if (k->module->tied)
        PCG_TRY(note_tied(c, s, k));
    PCG_TRY(make_frame(c, s->info, k));
    k->node = c->node;
    if (s->info->kind == PCG_SURROGATE_PROFILE)
        profile_begin(c->run, k);
    k->next = s->choices->all;
    s->choices->all = *to = k;
    return PCG_OK;
}

static bool room_for(pcg_run *r, pcg_choices *all, pcg_u32 number)
{
    if (number < all->capacity)
        return true;
    size_t old = all->capacity * sizeof *all->by_name, size = old ? old * 2 : 8 * sizeof *all->by_name;
    pcg_choice **more = run_resize(r, all->by_name, old, size);
    if (!more)
        return false;
    all->by_name = more;
    all->capacity = (pcg_u32)(size / sizeof *more);
    return true;
}

int pcg_surrogate_choose(pcg_call *c, pcg_surrogate *s, const char *name)
{
    pcg_run *r = c->run;
    if (!s->choices)
        s->choices = run_alloc_zeroed(r, sizeof *s->choices);
    pcg_choices *all = s->choices;
    if (!all)
        return r->status;
    if (all->last && !strcmp(all->last, name))
        return PCG_OK;
    pcg_u32 known = all->names.count, number = keys_number(r, &all->names, name);
    if (number == KEYS_NONE || !room_for(r, all, number))
        return r->status;
    if (number == known)
        PCG_TRY(choose_new(c, s, name, &all->by_name[number]));
    s->choice = all->by_name[number];
    all->last = all->names.at[number];
    return PCG_OK;
}

/* ---- parameters ----------------------------------------------------------------------------- */

static int give(pcg_call *c, pcg_choice *k, const pcg_parameter_info *p, const pcg_cell *value)
{
    pcg_cell *to = choice_at(k, p->offset);
    pcg_u8 *given = choice_at(k, p->given);
    size_t size = value_width(p->kind) * sizeof *to;
    if (*given && !memcmp(to, value, size))
        return PCG_OK;
    for (pcg_u32 i = 0; i < p->constraint_count; i++)
        PCG_TRY(pcg_constrain(c, p->name, &p->constraints[i], value, p->kind, p->element,
                              p->enumerators));
    memcpy(to, value, size);
    *given = 1;
    k->stale = true;
    return PCG_OK;
}

int pcg_surrogate_set(pcg_call *c, pcg_surrogate *s, pcg_u32 parameter, const pcg_cell *value)
{
    return give(c, s->choice, s->choice->parameters[parameter], value);
}

/* ---- entering ------------------------------------------------------------------------------- */

int pcg_surrogate_admit(pcg_call *c, pcg_surrogate *s, pcg_entity *e)
{
    (void)c;
    return pcg_enter(s->choice->frame, e, s->choice->below);
}

void pcg_surrogate_hand_in(pcg_call *c, pcg_surrogate *s, pcg_u32 attribute, pcg_entity *e,
                           const pcg_cell *value)
{
    pcg_set_cells(c->run, e, &s->choice->slots[attribute], value);
}

int pcg_surrogate_enter(pcg_call *c, pcg_surrogate *s, pcg_u32 input, pcg_entity *e)
{
    s->choice->entered++;
    if (parallel_puts_off(c, s))
        return parallel_enter(c, s, input, e);
    return pcg_queue_push(c->run, s->choice->inputs[input], e);
}

/* ---- leaving -------------------------------------------------------------------------------- */

void surrogate_write_link(pcg_call *c, const pcg_choice *k, pcg_u32 number, const pcg_cell *value,
                          pcg_entity *e, const pcg_slot *to)
{
    const pcg_attribute_info *a = k->attributes[number];
    bool is_text = a->kind == PCG_STRING || a->kind == PCG_PATH;
    if ((to->kind == PCG_STRING || to->kind == PCG_PATH) && !is_text)
        pcg_set_string(c->run, e, to, pcg_text(c->run, value, a->kind, a->element, a->enumerators));
    else if (value_is_float(to->kind) && a->kind == PCG_INT)
        pcg_set_float(c->run, e, to, (double)value->i);
    else
        pcg_set_cells(c->run, e, to, value);
}

static void write_links(pcg_call *c, pcg_surrogate *s, const pcg_queue *q)
{
    for (pcg_u32 i = q->head; i < q->end; i++)
        for (pcg_u32 a = 0; a < s->info->attribute_count; a++)
            if (s->links[a])
                surrogate_write_link(c, s->choice, a, pcg_get(q->at[i], &s->choice->slots[a]),
                                     q->at[i], s->links[a]);
}

static int send_all(pcg_call *c, pcg_surrogate *s, pcg_u32 output)
{
    pcg_choice *k = s->choice;
    pcg_queue *q = choice_output(k, output);
    pcg_u32 to = k->outputs[output];
    while (PCG_READY(*q)) {
        pcg_entity *e = PCG_TAKE(*q);
        if (to == NO_OUTPUT) {
            pcg_entity_drop(c->run, e);
            continue;
        }
        k->left++;
        pcg_leave(c->run, e, k->below);
        PCG_TRY(pcg_emit(c, s->outputs[to], e));
    }
    return PCG_OK;
}

/* One entity may have come out twice: all links are written before any attribute is removed. */
static int leave(pcg_call *c, pcg_surrogate *s)
{
    const pcg_choice *k = s->choice;
    for (pcg_u32 i = 0; i < k->module->output_count && s->info->attribute_count; i++)
        if (k->outputs[i] != NO_OUTPUT)
            write_links(c, s, choice_output(k, i));
    for (pcg_u32 d = 0; d < s->info->output_count; d++)
        for (pcg_u32 i = 0; i < k->module->output_count; i++)
            if (k->outputs[i] == d)
                PCG_TRY(send_all(c, s, i));
    for (pcg_u32 i = 0; i < k->module->output_count; i++)
        if (k->outputs[i] == NO_OUTPUT)
            PCG_TRY(send_all(c, s, i));
    return PCG_OK;
}

/* ---- executing ------------------------------------------------------------------------------ */

/* A graph that looks at its parameters may have changed them, too. */
bool surrogate_is_stale(const pcg_surrogate *s)
{
    const pcg_choice *k = s->choice;
    return k->stale || k->frame->about || s->each_round || k->execution != s->execution;
}

int surrogate_execute(const pcg_surrogate *s)
{
    pcg_choice *k = s->choice;
    if (surrogate_is_stale(s))
        PCG_TRY((k->started ? k->module->restart : k->module->start)(k->frame));
    k->started = true;
    k->stale = false;
    k->execution = s->execution;
    return k->module->run(k->frame);
}

static void end_pool(pcg_choice *k)
{
    if (k->frame->pool)
        pcg_pool_end(k->frame);
}

/* What left the graph where a loop begins enters it again, with all that it carries. */
static int follow_loops(pcg_call *c, pcg_surrogate *s)
{
    pcg_choice *k = s->choice;
    for (pcg_u32 l = 0; l < s->info->loop_count; l++)
        for (pcg_u32 i = 0; i < k->module->gate_count; i++) {
            pcg_queue *q = choice_output(k, i);
            while (k->outputs[i] == s->info->loops[l].from && PCG_READY(*q))
                PCG_TRY(pcg_queue_push(c->run, k->inputs[s->info->loops[l].to], PCG_TAKE(*q)));
        }
    return PCG_OK;
}

/* The graph's parameter that is told the number of the time; NULL where none is wanted. */
static int index_parameter(pcg_call *c, const pcg_surrogate *s, const pcg_parameter_info **to)
{
    const pcg_module *m = s->choice->module;
    *to = NULL;
    if (!s->index || !*s->index)
        return PCG_OK;
    for (pcg_u32 i = 0; i < m->parameter_count; i++)
        if (!strcmp(m->parameters[i].name, s->index))
            *to = &m->parameters[i];
    if (!*to || (*to)->kind != PCG_INT)
        return pcg_fail(c, "graph '%s' has no parameter '%s' of type int, which is to be its index",
                        m->name, s->index);
    return PCG_OK;
}

/* Not once: what entered where a loop ends leaves where it begins. All else is dropped. */
static int pass_by(pcg_call *c, pcg_surrogate *s)
{
    pcg_choice *k = s->choice;
    for (pcg_u32 l = 0; l < s->info->loop_count; l++) {
        pcg_queue *q = k->inputs[s->info->loops[l].to];
        while (PCG_READY(*q)) {
            pcg_entity *e = PCG_TAKE(*q);
            pcg_leave(c->run, e, k->below);
            PCG_TRY(pcg_emit(c, s->outputs[s->info->loops[l].from], e));
        }
    }
    for (pcg_u32 i = 0; i < s->info->input_count; i++)
        while (PCG_READY(*k->inputs[i]))
            pcg_entity_drop(c->run, PCG_TAKE(*k->inputs[i]));
    return PCG_OK;
}

static int iterate(pcg_call *c, pcg_surrogate *s)
{
    pcg_choice *k = s->choice;
    const pcg_parameter_info *index;
    pcg_u64 lineage = k->frame->lineage;
    PCG_TRY(index_parameter(c, s, &index));
    if (s->times <= 0)
        return pass_by(c, s);
    for (pcg_int i = 0; i < s->times; i++) {
        pcg_cell number = {.i = i};
        if (index)
            PCG_TRY(give(c, k, index, &number));
        if (i > 0) {
            k->frame->lineage = pcg_mix(lineage, (pcg_u64)i);
            PCG_TRY(round_again(c));
            PCG_TRY(follow_loops(c, s));
        }
        PCG_TRY(surrogate_execute(s));
        if (i + 1 < s->times)
            pool_empty(k->frame);
    }
    return leave(c, s);
}

static int profile(pcg_call *c, pcg_surrogate *s)
{
    pcg_choice *k = s->choice;
    pcg_int begun = profile_clock();
    pcg_u64 rounds = c->run->rounds;
    PCG_TRY(surrogate_execute(s));
    k->time += profile_clock() - begun;
    k->rounds += c->run->rounds - rounds;
    k->executions++;
    return leave(c, s);
}

int surrogate_leave(pcg_call *c, pcg_surrogate *s)
{
    PCG_TRY(leave(c, s));
    end_pool(s->choice);
    return PCG_OK;
}

/* Rounds are numbered over all frames where the graph may be run in some other than this one. */
static int run_plainly(pcg_call *c, pcg_surrogate *s)
{
    bool before = c->run->by_module;
    c->run->by_module |= s->info->kind != PCG_SURROGATE_DYNAMIC && !s->choice->module->tied;
    int status = surrogate_execute(s);
    c->run->by_module = before;
    return status == PCG_OK ? leave(c, s) : status;
}

static int run_chosen(pcg_call *c, pcg_surrogate *s)
{
    switch (s->info->kind) {
    case PCG_SURROGATE_ITERATE:
        return iterate(c, s);
    case PCG_SURROGATE_PROFILE:
        return profile(c, s);
    case PCG_SURROGATE_CACHE:
        return cache_run(c, s);
    default:
        return run_plainly(c, s);
    }
}

int pcg_surrogate_run(pcg_call *c, pcg_surrogate *s, const pcg_entity *impulse)
{
    pcg_choice *k = s->choice;
    if (parallel_puts_off(c, s))
        return parallel_put_off(c, s, impulse);
    k->frame->lineage = c->lineage;
    ((pcg_graph *)k->frame)->impulse = impulse;
    PCG_TRY(run_chosen(c, s));
    end_pool(k);
    return PCG_OK;
}

int pcg_surrogate_finish(pcg_call *c, pcg_surrogate *s)
{
    return s->batch ? parallel_finish(c, s) : PCG_OK;
}
