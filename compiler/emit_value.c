/* emit_value.c - expressions: statements that come first, and an operand of C that stands for the
 * result.
 *
 * Functions are called in statements of their own, one after the other as the language orders
 * them (C does not order operands), and in branches where the language evaluates lazily. What is
 * written inline has no side effects. No operation is left to the C compiler whose operands are
 * all literals of floats: compilers fold those by different rules. */
#include "emit.h"

#include <string.h>

/* ---- operands -------------------------------------------------------------------------------- */

static operand atom(const char *expression)
{
    return (operand){expression, true};
}

/* As an operand of another operator. */
static const char *wrapped(emitter *e, operand o)
{
    return o.atomic ? o.text : emit_name(e, "(%s)", o.text);
}

/* More would not fit on the stack that a node may count on: reported once. */
static const char *new_variable(emitter *e)
{
    if (++e->variables == EMIT_MAX_VARIABLES) {
        span place = e->node ? e->node->span : e->form->graph->tree->name.span;
        diagnose(e->p->diagnostics, DIAG_E0602, place,
                 e->node ? e->node->name : e->form->graph->name, (int)EMIT_MAX_VARIABLES);
    }
    return emit_name(e, "t%u", e->variables);
}

/* Gives what is not a literal or a name a variable. */
static operand spill(emitter *e, const type *t, const char *expression)
{
    const char *name = new_variable(e);
    const char *c = emit_c_type(e, t);
    bool pointer = c[strlen(c) - 1] == '*';
    emit_line(e, pointer ? "%s%s = %s;" : "const %s%s = %s;", c, name, expression);
    return atom(name);
}

/* An operand; in a variable of its own where it would become hard to read. */
static operand make(emitter *e, const type *t, bool atomic, const char *expression)
{
    if (strlen(expression) > EMIT_OPERAND_LENGTH) {
        return spill(e, t, expression);
    }
    return (operand){expression, atomic};
}

static const char *address(emitter *e, operand o)
{
    return emit_name(e, "&%s", o.text);
}

/* A composite: of two others and an operator, of one, of constants, of cells, or of operands. */
typedef struct parts {
    const type *type;
    const operand *left, *right; /* composites, or scalars */
    const type *left_type, *right_type;
    const char *sign;
    const pcg_cell *constants;
    const char *cells;
    const operand *each;
} parts;

static const char *part_of(emitter *e, operand o, const type *t, uint32_t i)
{
    return emit_is_composite(t) ? emit_name(e, "%s.%s", o.text, emit_component(t, i))
                                : wrapped(e, o);
}

static const char *part(emitter *e, const parts *p, uint32_t i)
{
    if (p->constants) {
        return emit_float(e, p->constants[i].f);
    }
    if (p->cells) {
        return emit_name(e, "%s[%u].f", p->cells, i);
    }
    if (p->each) {
        return p->each[i].text;
    }
    const char *left = part_of(e, *p->left, p->left_type, i);
    if (!p->right) {
        return emit_name(e, "%s%s", p->sign, left);
    }
    return emit_name(e, "%s %s %s", left, p->sign, part_of(e, *p->right, p->right_type, i));
}

static operand compose(emitter *e, const parts *p)
{
    text list = {.arena = e->arena};
    for (uint32_t i = 0; i < type_components(p->type); i++) {
        text_format(&list, "%s%s", i ? ", " : "", part(e, p, i));
    }
    const char *name = new_variable(e);
    emit_line(e, "const %s%s = {%s};", emit_c_type(e, p->type), name, list.at);
    return atom(name);
}

/* ---- literals and names ---------------------------------------------------------------------- */

static operand emit_constant(emitter *e, const value *v)
{
    const pcg_cell *cell = v->any.cell;
    if (type_components(&v->type) > 0) {
        const parts p = {.type = &v->type, .constants = cell};
        return compose(e, &p);
    }
    switch (v->type.value) {
    case PCG_BOOL:
        return atom(cell->i ? "1" : "0");
    case PCG_INT:
        return (operand){emit_int(e, cell->i), cell->i >= 0};
    case PCG_STRING:
    case PCG_PATH:
        return atom(emit_string(e, v->string ? v->string : ""));
    case PCG_ENUM:
        return atom(interface_constant(e->arena, v->type.enumeration->name,
                                       v->type.enumeration->names[cell->i]));
    default:
        return (operand){emit_float(e, cell->f), !(cell->f < 0)};
    }
}

static operand emit_parameter(emitter *e, const value *v)
{
    const char *name = e->form->names->parameters[v->parameter->index];
    bool narrow = type_is(&v->type, PCG_BOOL) || type_is(&v->type, PCG_ENUM);
    return (operand){emit_name(e, narrow ? "(int)g->parameter.%s" : "g->parameter.%s", name),
                     !narrow};
}

static const char *entity_at(const emitter *e, const port *p)
{
    return e->entities[p ? p->index : 0];
}

static operand emit_attribute(emitter *e, const value *v)
{
    const char *name = e->form->names->attributes[v->attribute->index];
    const char *cells = emit_name(e, "pcg_get(%s, &g->attribute.%s)", entity_at(e, v->port), name);
    if (type_components(&v->type) > 0) {
        const char *at = new_variable(e);
        emit_line(e, "const pcg_cell *%s = %s;", at, cells);
        const parts p = {.type = &v->type, .cells = at};
        return compose(e, &p);
    }
    bool narrow = type_is(&v->type, PCG_BOOL) || type_is(&v->type, PCG_ENUM);
    return make(e, &v->type, !narrow,
                emit_name(e, "%s%s->%s", narrow ? "(int)" : "", cells, emit_cell_member(&v->type)));
}

/* vec3(1, 2, 3): no call is needed for what C can write. */
static bool makes_vector(const value *v)
{
    return v->kind == VALUE_CALL && strcmp(v->function->library->name, "core") == 0 &&
           strncmp(v->function->name, "vec", 3) == 0 && v->count > 1 &&
           v->count == type_components(&v->function->result);
}

static operand emit_vector(emitter *e, const value *v)
{
    operand each[4];
    for (uint32_t i = 0; i < v->count; i++) {
        each[i] = emit_value(e, v->operands[i]);
    }
    const parts p = {.type = &v->type, .each = each};
    return compose(e, &p);
}

/* ---- lists ----------------------------------------------------------------------------------- */

static bool is_literal(const value *v)
{
    for (uint32_t i = 0; i < v->count && makes_vector(v); i++) {
        if (v->operands[i]->kind != VALUE_CONSTANT) {
            return false;
        }
    }
    return v->kind == VALUE_CONSTANT || makes_vector(v);
}

static bool is_literal_list(const value *v)
{
    for (uint32_t i = 0; i < v->count; i++) {
        if (!is_literal(v->operands[i])) {
            return false;
        }
    }
    return true;
}

/* "{.i = 3}": the cells of one literal, one behind the other. */
static void add_literal_cells(emitter *e, text *line, const value *v)
{
    for (uint32_t i = 0; i < type_cells(&v->type); i++) {
        const value *of = makes_vector(v) ? v->operands[i] : v;
        const char *literal = type_components(&of->type) > 0 ? emit_float(e, of->any.cell[i].f)
                                                             : emit_constant(e, of).text;
        text_format(line, "%s{.%s = %s}", line->length ? ", " : "", emit_cell_member(&v->type),
                    literal);
    }
}

static operand emit_literal_list(emitter *e, const value *v)
{
    enum { LINE_LENGTH = 80 };
    const char *name = new_variable(e);
    const span *place = e->place;
    uint32_t width = type_cells(v->type.element);
    emit_place(e, NULL);
    emit_line(e, "static const struct {");
    emit_line(e, "    pcg_u32 count, width;");
    emit_line(e, "    pcg_cell at[%u];", v->count ? v->count * width : 1);
    emit_line(e, "} %s = {%u, %u, {", name, v->count, width);
    text line = {.arena = e->arena};
    for (uint32_t i = 0; i < v->count; i++) {
        add_literal_cells(e, &line, v->operands[i]);
        if (line.length > LINE_LENGTH || i + 1 == v->count) {
            emit_line(e, "    %s%s", line.at, i + 1 < v->count ? "," : "");
            line.length = 0;
        }
    }
    emit_line(e, "%s}};", v->count ? "" : "    {.i = 0}");
    emit_place(e, place);
    return (operand){emit_name(e, "(const pcg_list *)&%s", name), false};
}

static operand emit_list(emitter *e, const value *v)
{
    if (is_literal_list(v)) {
        return emit_literal_list(e, v);
    }
    const char *name = new_variable(e);
    uint32_t width = type_cells(v->type.element);
    e->uses_call = true;
    emit_line(e, "pcg_list *%s = pcg_list_new(g->frame.run, %u, %u);", name, v->count, width);
    emit_line(e, "if (!%s)", name);
    emit_line(e, "    return PCG_FAILED;");
    for (uint32_t i = 0; i < v->count; i++) {
        emit_cells(e, emit_name(e, "(%s->at + %u)", name, i * width), v->operands[i]);
    }
    return atom(name);
}

/* ---- branches -------------------------------------------------------------------------------- */

/* A value whose statements go into a text of their own. */
typedef struct branch {
    operand result;
    text statements;
} branch;

static void emit_branch(emitter *e, const value *v, branch *b)
{
    text *before = emit_capture(e, &b->statements);
    e->depth++;
    b->result = emit_value(e, v);
    e->depth--;
    emit_restore(e, before, NULL);
}

static void add_branch(emitter *e, const branch *b, const char *to)
{
    emit_restore(e, e->out, &b->statements);
    emit_line(e, "    %s = %s;", to, b->result.text);
}

static operand emit_choice(emitter *e, const value *v)
{
    branch yes, no;
    operand condition = emit_value(e, v->operands[0]);
    emit_branch(e, v->operands[1], &yes);
    emit_branch(e, v->operands[2], &no);
    if (yes.statements.length == 0 && no.statements.length == 0 && !emit_is_composite(&v->type)) {
        return make(e, &v->type, false,
                    emit_name(e, "%s ? %s : %s", wrapped(e, condition), wrapped(e, yes.result),
                              wrapped(e, no.result)));
    }
    const char *name = new_variable(e);
    emit_line(e, "%s%s;", emit_c_type(e, &v->type), name);
    emit_line(e, "if (%s) {", condition.text);
    add_branch(e, &yes, name);
    emit_line(e, "} else {");
    add_branch(e, &no, name);
    emit_line(e, "}");
    return atom(name);
}

static operand emit_logical(emitter *e, const value *v)
{
    branch second;
    bool both = v->op == OP_AND;
    operand first = emit_value(e, v->operands[0]);
    emit_branch(e, v->operands[1], &second);
    if (second.statements.length == 0) {
        return make(e, &v->type, false,
                    emit_name(e, "%s %s %s", wrapped(e, first), both ? "&&" : "||",
                              wrapped(e, second.result)));
    }
    const char *name = new_variable(e);
    emit_line(e, "int %s = %s;", name, first.text);
    emit_line(e, both ? "if (%s) {" : "if (!%s) {", name);
    add_branch(e, &second, name);
    emit_line(e, "}");
    return atom(name);
}

/* ---- operators ------------------------------------------------------------------------------- */

static operand emit_unary(emitter *e, const value *v)
{
    operand o = emit_value(e, v->operands[0]);
    const char *sign = v->op == OP_NOT ? "!" : v->op == OP_COMPLEMENT ? "~" : "-";
    if (type_components(&v->type) > 0) {
        const parts p = {
            .type = &v->type, .left = &o, .left_type = &v->operands[0]->type, .sign = sign};
        return compose(e, &p);
    }
    if (v->op == OP_NEGATE && type_is(&v->type, PCG_INT)) {
        return make(e, &v->type, true, emit_name(e, "PCG_INT_SUBTRACT(0, %s)", o.text));
    }
    return make(e, &v->type, false, emit_name(e, "%s%s", sign, wrapped(e, o)));
}

/* What may fail, or is more than an operator of C: written to a variable by a function of the
 * runtime. */
static operand emit_checked(emitter *e, const char *by, operand a, operand b)
{
    const char *name = new_variable(e);
    e->uses_call = true;
    emit_line(e, "pcg_int %s;", name);
    emit_line(e, "PCG_TRY(%s(%s, %s, %s, &%s));", by, e->call, a.text, b.text, name);
    return atom(name);
}

/* Whether a constant divisor or shift cannot fail, so that C's own operator does. */
static bool is_harmless(const value *v, tree_operator op)
{
    if (v->kind != VALUE_CONSTANT) {
        return false;
    }
    pcg_int by = v->any.cell[0].i;
    bool shift = op == OP_SHIFT_LEFT || op == OP_SHIFT_RIGHT;
    return shift ? false : by > 0;
}

static operand emit_integer(emitter *e, const value *v, operand a, operand b)
{
    static const char *const functions[] = {
        [OP_MULTIPLY] = "PCG_INT_MULTIPLY",      [OP_ADD] = "PCG_INT_ADD",
        [OP_SUBTRACT] = "PCG_INT_SUBTRACT",      [OP_DIVIDE] = "pcg_int_divide",
        [OP_REMAINDER] = "pcg_int_remainder",    [OP_SHIFT_LEFT] = "pcg_int_shift_left",
        [OP_SHIFT_RIGHT] = "pcg_int_shift_right"};
    switch (v->op) {
    case OP_ADD:
    case OP_SUBTRACT:
    case OP_MULTIPLY:
        return make(e, &v->type, true,
                    emit_name(e, "%s(%s, %s)", functions[v->op], a.text, b.text));
    case OP_DIVIDE:
    case OP_REMAINDER:
    case OP_SHIFT_LEFT:
    case OP_SHIFT_RIGHT:
        if (!is_harmless(v->operands[1], v->op)) {
            return emit_checked(e, functions[v->op], a, b);
        }
        break;
    default:
        break;
    }
    return make(e, &v->type, false,
                emit_name(e, "%s %s %s", wrapped(e, a), operator_text(v->op), wrapped(e, b)));
}

/* == and != of values of several components hold of all of them, or of any. */
static operand emit_equality(emitter *e, const value *v, operand a, operand b)
{
    const type *of = &v->operands[0]->type;
    text all = {.arena = e->arena};
    for (uint32_t i = 0; i < type_components(of); i++) {
        text_add(&all, i == 0 ? "" : v->op == OP_EQUAL ? " && " : " || ");
        text_format(&all, "%s %s %s", part_of(e, a, of, i), operator_text(v->op),
                    part_of(e, b, of, i));
    }
    return make(e, &v->type, false, all.at);
}

static operand emit_comparison(emitter *e, const value *v, operand a, operand b)
{
    const type *of = &v->operands[0]->type;
    const char *sign = operator_text(v->op);
    if (type_components(of) > 0) {
        return emit_equality(e, v, a, b);
    }
    if (type_is_text(of)) {
        return make(e, &v->type, false,
                    emit_name(e, "pcg_string_compare(%s, %s) %s 0", a.text, b.text, sign));
    }
    if (type_is(of, PCG_LIST)) {
        const char *equal =
            emit_name(e, "pcg_list_equal(%s, %s, %s)", a.text, b.text, emit_kind(of->element));
        return make(e, &v->type, true, emit_name(e, "%s%s", v->op == OP_EQUAL ? "" : "!", equal));
    }
    /* Compilers warn of comparing a thing with itself; whoever wrote it has a right to an
     * answer. */
    if (strcmp(a.text, b.text) == 0) {
        a = spill(e, of, a.text);
    }
    return make(e, &v->type, false, emit_name(e, "%s %s %s", wrapped(e, a), sign, wrapped(e, b)));
}

static bool is_comparison(tree_operator op)
{
    return op >= OP_LESS && op <= OP_NOT_EQUAL;
}

/* Two literals of floats: what the processor makes of them. */
static double fold(const value *v)
{
    double a = v->operands[0]->any.cell[0].f, b = v->operands[1]->any.cell[0].f;
    switch (v->op) {
    case OP_MULTIPLY:
        return a * b;
    case OP_DIVIDE:
        return a / b;
    case OP_SUBTRACT:
        return a - b;
    default:
        return a + b;
    }
}

static bool is_float(const type *t)
{
    return type_is(t, PCG_FLOAT) || type_is_unit(t);
}

static bool is_float_literal(const value *v)
{
    return v->kind == VALUE_CONSTANT && is_float(&v->type);
}

static operand emit_binary(emitter *e, const value *v)
{
    if (v->op == OP_AND || v->op == OP_OR) {
        return emit_logical(e, v);
    }
    const value *left = v->operands[0], *right = v->operands[1];
    operand a = emit_value(e, left), b = emit_value(e, right);
    if (is_comparison(v->op)) {
        return emit_comparison(e, v, a, b);
    }
    if (type_components(&v->type) > 0) {
        const parts p = {.type = &v->type,
                         .left = &a,
                         .right = &b,
                         .left_type = &left->type,
                         .right_type = &right->type,
                         .sign = operator_text(v->op)};
        return compose(e, &p);
    }
    if (type_is_text(&v->type)) {
        e->uses_call = true;
        return spill(e, &v->type,
                     emit_name(e, "pcg_string_join(g->frame.run, %s, %s)", a.text, b.text));
    }
    if (type_is(&v->type, PCG_INT)) {
        return emit_integer(e, v, a, b);
    }
    if (is_float_literal(left) && is_float_literal(right)) {
        return (operand){emit_float(e, fold(v)), false};
    }
    return make(e, &v->type, false,
                emit_name(e, "%s %s %s", wrapped(e, a), operator_text(v->op), wrapped(e, b)));
}

/* ---- conversions ----------------------------------------------------------------------------- */

static operand emit_text(emitter *e, const value *of, const type *to)
{
    const type *from = &of->type;
    const char *cells = new_variable(e);
    emit_line(e, "pcg_cell %s[%u];", cells, type_cells(from));
    emit_cells(e, cells, of);
    const char *element = type_is(from, PCG_LIST) ? emit_kind(from->element) : "0";
    return spill(e, to,
                 emit_name(e, "pcg_text(g->frame.run, %s, %s, %s, %s)", cells, emit_kind(from),
                           element, emit_enumerators(e, from)));
}

static operand emit_conversion(emitter *e, const value *v)
{
    const value *of = v->operands[0];
    if (type_is(&of->type, PCG_INT) && is_float(&v->type)) {
        if (of->kind == VALUE_CONSTANT) {
            return (operand){emit_float(e, (double)of->any.cell[0].i), false};
        }
        operand o = emit_value(e, of);
        return make(e, &v->type, false, emit_name(e, "(double)%s", wrapped(e, o)));
    }
    if (type_is_text(&v->type) && !type_is_text(&of->type)) {
        return emit_text(e, of, &v->type);
    }
    return emit_value(e, of);
}

/* ---- calls ----------------------------------------------------------------------------------- */

/* An enumerator goes as its name where nothing else says what its number means; so does a list. */
static bool goes_as_text(const type *t)
{
    return type_is(t, PCG_ENUM) || type_is(t, PCG_LIST);
}

/* to.kind = …; to.cell[…] = … */
static void emit_any(emitter *e, const char *to, const value *v, bool keeps_kind)
{
    if (goes_as_text(&v->type) && !keeps_kind) {
        operand o = emit_text(e, v, &type_string);
        emit_line(e, "%s.kind = PCG_STRING;", to);
        emit_line(e, "%s.cell[0].s = %s;", to, o.text);
        return;
    }
    emit_line(e, "%s.kind = %s;", to, emit_kind(&v->type));
    emit_cells(e, emit_name(e, "%s.cell", to), v);
}

static void add_argument(emitter *e, text *list, const formal *f, const value *v)
{
    if (f->type.kind == TYPE_ANY) {
        const char *name = new_variable(e);
        emit_line(e, "pcg_any %s;", name);
        emit_any(e, name, v, false);
        text_format(list, ", &%s", name);
        return;
    }
    operand o = emit_value(e, v);
    text_format(list, ", %s", emit_is_composite(&f->type) ? address(e, o) : o.text);
}

static void add_remaining(emitter *e, text *list, const value *v, uint32_t from)
{
    uint32_t count = v->count > from ? v->count - from : 0;
    if (count == 0) {
        text_add(list, ", 0, 0");
        return;
    }
    const char *name = new_variable(e);
    if (count > EMIT_MOST_ON_STACK) {
        emit_line(e, "pcg_any *%s = pcg_alloc(g->frame.run, %u * sizeof *%s);", name, count, name);
        emit_line(e, "if (!%s)", name);
        emit_line(e, "    return PCG_FAILED;");
    } else {
        emit_line(e, "pcg_any %s[%u];", name, count);
    }
    for (uint32_t i = 0; i < count; i++) {
        emit_any(e, emit_name(e, "%s[%u]", name, i), v->operands[from + i], false);
    }
    text_format(list, ", %s, %u", name, count);
}

static operand emit_call(emitter *e, const value *v)
{
    const function *f = v->function;
    if (makes_vector(v)) {
        return emit_vector(e, v);
    }
    text list = {.arena = e->arena};
    e->uses_call = true;
    text_add(&list, e->call);
    if (f->traits & TRAIT_RANDOM) {
        text_format(&list, ", %u", v->site);
    }
    for (uint32_t i = 0; i < f->parameter_count; i++) {
        if (f->parameters[i].collective) {
            add_remaining(e, &list, v, i);
        } else {
            add_argument(e, &list, &f->parameters[i], v->operands[i]);
        }
    }
    const char *kernel = emit_kernel_name(e, f->symbol, e->call);
    if (!emit_is_composite(&f->result)) {
        return spill(e, &f->result, emit_name(e, "%s(%s)", kernel, list.at));
    }
    const char *name = new_variable(e);
    emit_line(e, "%s%s;", emit_c_type(e, &f->result), name);
    emit_line(e, "%s(%s, &%s);", kernel, list.at, name);
    return atom(name);
}

static operand emit_entity(emitter *e, const value *v)
{
    return (operand){emit_name(e, "(const void *)%s", entity_at(e, v->port)), false};
}

/* ---- values ---------------------------------------------------------------------------------- */

operand emit_value(emitter *e, const value *v)
{
    switch (v->kind) {
    case VALUE_CONSTANT:
        return emit_constant(e, v);
    case VALUE_LIST:
        return emit_list(e, v);
    case VALUE_PARAMETER:
        return emit_parameter(e, v);
    case VALUE_CONST:
        return atom(emit_name(e, "g->constant.%s", e->form->names->constants[v->constant->index]));
    case VALUE_ATTRIBUTE:
        return emit_attribute(e, v);
    case VALUE_ENTITY:
        return emit_entity(e, v);
    case VALUE_COMPONENT: {
        operand of = emit_value(e, v->operands[0]);
        return atom(
            emit_name(e, "%s.%s", of.text, emit_component(&v->operands[0]->type, v->component)));
    }
    case VALUE_UNARY:
        return emit_unary(e, v);
    case VALUE_BINARY:
        return emit_binary(e, v);
    case VALUE_CHOICE:
        return emit_choice(e, v);
    case VALUE_CALL:
        return emit_call(e, v);
    case VALUE_CONVERT:
        return emit_conversion(e, v);
    case VALUE_SLOT:
        return atom(
            emit_name(e, "g->attribute.%s", e->form->names->attributes[v->attribute->index]));
    case VALUE_ERROR:
        break;
    }
    return atom("0");
}

void emit_assign(emitter *e, const char *to, const type *t, const value *v, bool keeps_kind)
{
    if (t->kind == TYPE_ANY) {
        emit_any(e, to, v, keeps_kind);
        return;
    }
    operand o = emit_value(e, v);
    emit_line(e, "%s = %s;", to, o.text);
}

static void store_cells(emitter *e, const char *to, const type *t, operand o)
{
    if (type_components(t) == 0) {
        emit_line(e, "%s[0].%s = %s;", to, emit_cell_member(t), o.text);
        return;
    }
    for (uint32_t i = 0; i < type_components(t); i++) {
        emit_line(e, "%s[%u].f = %s;", to, i, part_of(e, o, t, i));
    }
}

void emit_cells(emitter *e, const char *to, const value *v)
{
    store_cells(e, to, &v->type, emit_value(e, v));
}

bool emit_is_fixed(const value *v)
{
    bool number =
        v->kind == VALUE_CONVERT && is_float(&v->type) && v->operands[0]->kind == VALUE_CONSTANT;
    return v->kind == VALUE_CONSTANT || v->kind == VALUE_SLOT || number ||
           (v->kind == VALUE_LIST && is_literal_list(v));
}

void emit_convert_cells(emitter *e, const char *to, const type *to_type, const char *from,
                        const type *from_type)
{
    if (type_is_text(to_type) && !type_is_text(from_type)) {
        const char *element = type_is(from_type, PCG_LIST) ? emit_kind(from_type->element) : "0";
        emit_line(e, "%s[0].s = pcg_text(g->frame.run, %s, %s, %s, %s);", to, from,
                  emit_kind(from_type), element, emit_enumerators(e, from_type));
        return;
    }
    if (is_float(to_type) && type_is(from_type, PCG_INT)) {
        emit_line(e, "%s[0].f = (double)%s[0].i;", to, from);
        return;
    }
    for (uint32_t i = 0; i < type_cells(to_type); i++) {
        emit_line(e, "%s[%u] = %s[%u];", to, i, from, i);
    }
}

/* Numbers in a range are the usual case: they are compared here. */
static void emit_constraint(emitter *e, const char *name, const pcg_constraint_info *demand,
                            const type *t, const char *at)
{
    const char *own = new_variable(e);
    if (demand->kind == 0 && type_is_number(t)) {
        const char *sign = type_is(t, PCG_INT) ? "(double)" : "";
        emit_open(e, "if (!(%s%s >= %s && %s%s <= %s))", sign, at, emit_float(e, demand->low), sign,
                  at, emit_float(e, demand->high));
    } else {
        emit_block(e);
    }
    emit_line(e, "static const pcg_constraint_info %s = {%d, %s, %s, %s};", own, demand->kind,
              emit_float(e, demand->low), emit_float(e, demand->high),
              emit_string(e, demand->text));
    emit_line(e, "pcg_cell %s_cells[%u];", own, type_cells(t));
    store_cells(e, emit_name(e, "%s_cells", own), t, atom(at));
    emit_line(e, "PCG_TRY(pcg_constrain(%s, %s, &%s, %s_cells, %s, %s, %s));", e->call,
              emit_string(e, name), own, own, emit_kind(t),
              type_is(t, PCG_LIST) ? emit_kind(t->element) : "0", emit_enumerators(e, t));
    emit_close(e, "");
    e->uses_call = true;
}

void emit_constraints(emitter *e, const char *name, const pcg_constraint_info *constraints,
                      uint32_t count, const type *t, const value *v, const char *at)
{
    for (uint32_t i = 0; i < count && v->kind != VALUE_CONSTANT; i++) {
        emit_constraint(e, name, &constraints[i], t, at);
    }
}
