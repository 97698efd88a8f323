/* run.c - a run from making to results: rounds, sending, copies, attributes, what is reported at
 * its end. */
#include "tests/unit/unit.h"
#include "toy.h"

typedef struct heard {
    int notes, warnings, errors;
    char text[16][400], rendered[16][600];
    int count;
} heard;

static void hear(void *user, const pcg_message *m)
{
    heard *h = user;
    h->notes += m->severity == PCG_NOTE;
    h->warnings += m->severity == PCG_WARNING;
    h->errors += m->severity == PCG_ERROR;
    if (h->count < 16) {
        snprintf(h->text[h->count], sizeof h->text[0], "%s %s", m->code, m->text);
        snprintf(h->rendered[h->count], sizeof h->rendered[0], "%s", m->rendered);
        h->count++;
    }
}

static const char *all_of(const heard *h)
{
    static char all[16 * 400];
    all[0] = '\0';
    for (int i = 0; i < h->count; i++) {
        strcat(all, h->text[i]);
        strcat(all, "\n");
    }
    return all;
}

static void describes_itself(const pcg_program *p)
{
    pcg_parameter parameter;
    pcg_gate gate;
    CHECK_TEXT(pcg_program_name(p), "toy");
    CHECK_TEXT(pcg_program_document(p), "A toy.\nFor tests.");
    CHECK_NUMBER(pcg_program_parameter_count(p), 8);
    CHECK(pcg_program_parameter(p, 1, &parameter));
    CHECK_TEXT(parameter.name, "height");
    CHECK_TEXT(parameter.type, "length");
    CHECK_TEXT(parameter.initial, "2m");
    CHECK(!parameter.hidden);
    CHECK(pcg_program_parameter(p, 3, &parameter) && parameter.hidden);
    CHECK(!pcg_program_parameter(p, 8, &parameter));
    CHECK_NUMBER(pcg_program_input_count(p), 2);
    CHECK(pcg_program_input(p, 0, &gate));
    CHECK_TEXT(gate.name, "lot");
    CHECK_TEXT(gate.document, "What is built on.");
    CHECK(!pcg_program_input(p, 2, &gate));
    CHECK_NUMBER(pcg_program_output_count(p), 3);
    CHECK(pcg_program_output(p, 2, &gate));
    CHECK_TEXT(gate.name, "again");
    CHECK_NUMBER(pcg_program_attribute_count(p), 3);
    CHECK_TEXT(pcg_program_attribute_name(p, 1), "side");
    CHECK(pcg_program_attribute_name(p, 3) == NULL);
}

static void nothing_before_it_ran(const pcg_program *p)
{
    pcg_run *r = pcg_run_new(p, NULL);
    double number;
    pcg_mesh_view view = {.size = sizeof view};
    CHECK_NUMBER(pcg_run_output_count(r, 0), 0);
    CHECK_NUMBER(pcg_run_face_count(r), 0);
    CHECK_NUMBER(pcg_run_vertex_count(r), 0);
    CHECK_NUMBER(pcg_run_material_count(r), 0);
    CHECK(pcg_run_attribute(r, 0, 0, "number") == NULL);
    CHECK_NUMBER(pcg_run_attribute_float(r, 0, 0, "number", &number), PCG_STATUS_MISUSE);
    CHECK_NUMBER(pcg_run_mesh(r, 0, 0, &view), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "output 0 has no entity 0");
    pcg_run_free(r);
}

static void sends_and_copies(const pcg_program *p)
{
    pcg_run *r = pcg_run_new(p, NULL);
    double number = 0;
    CHECK_NUMBER(pcg_run_set_int(r, "count", 5), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_TEXT(pcg_run_error(r), "");
    CHECK_NUMBER(pcg_run_output_count(r, 0), 3);
    CHECK_NUMBER(pcg_run_output_count(r, 1), 2);
    CHECK_NUMBER(pcg_run_output_count(r, 2), 3);
    CHECK_NUMBER(pcg_run_output_count(r, 3), 0);
    CHECK_NUMBER(pcg_run_face_count(r), 8);
    CHECK_NUMBER(pcg_run_vertex_count(r), 32);
    CHECK_TEXT(pcg_run_attribute(r, 0, 2, "number"), "4");
    CHECK_TEXT(pcg_run_attribute(r, 1, 0, "label"), "no. 1");
    CHECK_TEXT(pcg_run_attribute(r, 2, 1, "label"), "no. 2");
    CHECK_TEXT(pcg_run_attribute(r, 0, 0, "side"), "2m");
    CHECK(pcg_run_attribute(r, 0, 0, "nothing") == NULL);
    CHECK(pcg_run_attribute(r, 0, 3, "side") == NULL);
    CHECK_NUMBER(pcg_run_attribute_float(r, 1, 1, "number", &number), PCG_STATUS_OK);
    CHECK_NUMBER(number, 3);
    CHECK_NUMBER(pcg_run_attribute_float(r, 1, 1, "label", &number), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "attribute 'label' is of type string, no number");
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_MISUSE);
    CHECK_PART(pcg_run_error(r), "executed already");
    CHECK_NUMBER(pcg_run_set(r, "count", "3"), PCG_STATUS_MISUSE);
    CHECK_PART(pcg_run_error(r), "comes too late");
    pcg_run_free(r);
}

static void tells_where_nothing_came(const pcg_program *p)
{
    heard h = {0};
    const pcg_run_options options = {.size = sizeof options, .message = hear, .user = &h};
    pcg_run *r = pcg_run_new(p, &options);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_PART(
        all_of(&h),
        "W0501 'lonely' received nothing (2 went to 'sorter.even', 2 went to 'sorter.odd')\n");
    CHECK(!strstr(all_of(&h), "'beyond' received nothing"));
    CHECK(!strstr(all_of(&h), "'pairing' received nothing"));
    CHECK_PART(all_of(&h), "W0702 2 entities were left at 'pairing.left' when the graph was done");
    CHECK_PART(all_of(&h), "W0704 nothing was fed to input 'lot', which has no stand-in\n");
    CHECK_NUMBER(h.warnings, 3);
    CHECK_NUMBER(h.errors, 0);
    CHECK_TEXT(
        h.rendered[0],
        "toy.pcg:16:5: warning: 2 entities were left at 'pairing.left' when the graph was done: "
        "another input had nothing left to go with [W0702]\n");
    pcg_run_free(r);
}

static void tells_what_ran_and_sent_nothing(const pcg_program *p)
{
    heard h = {0};
    const pcg_run_options options = {.size = sizeof options, .message = hear, .user = &h};
    pcg_run *r = pcg_run_new(p, &options);
    CHECK_NUMBER(pcg_run_set_int(r, "count", 0), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_PART(all_of(&h),
               "W0501 'sorter' received nothing ('maker' ran 1 round and sent nothing)\n");
    CHECK(!strstr(all_of(&h), "'even' received nothing"));
    CHECK_NUMBER(h.warnings, 2);
    pcg_run_free(r);
}

static void old_hosts_give_less(const pcg_program *p)
{
    const pcg_run_options options = {
        .size = offsetof(pcg_run_options, strict), .seed = 7, .max_rounds = 1};
    pcg_run *r = pcg_run_new(p, &options);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    pcg_run_free(r);
}

int main(void)
{
    pcg_program *p = pcg_program_of(&toy_module);
    pcg_module other = toy_module;
    CHECK(p != NULL);
    other.abi++;
    CHECK(pcg_program_of(&other) == NULL);
    CHECK(pcg_program_of(NULL) == NULL);
    CHECK(pcg_run_new(NULL, NULL) == NULL);
    describes_itself(p);
    nothing_before_it_ran(p);
    sends_and_copies(p);
    tells_where_nothing_came(p);
    tells_what_ran_and_sent_nothing(p);
    old_hosts_give_less(p);
    pcg_run_free(NULL);
    pcg_program_free(p);
    pcg_program_free(NULL);
    return unit_done();
}
