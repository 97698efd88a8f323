/* inputs.c - feeding input gates with meshes: what comes out is what went in; what makes no sense
 * is refused. */
#include <stdint.h>

#include "tests/unit/unit.h"
#include "toy.h"

static pcg_program *program;

/* A roof of two faces over six points, tilted and far from the origin. */
static const double points[] = {100, 50, 3, 110, 50, 3, 110, 54, 6,
                                100, 54, 6, 110, 58, 3, 100, 58, 3};
static const uint32_t counts[] = {4, 4};
static const uint32_t corners[] = {0, 1, 2, 3, 3, 2, 4, 5};

static void comes_out_as_it_went_in(void)
{
    pcg_run *r = pcg_run_new(program, NULL);
    pcg_mesh_view view = {.size = sizeof view};
    CHECK_NUMBER(pcg_run_set_int(r, "count", 1), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_input_mesh(r, "lot", points, 6, counts, 2, corners), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_input_mesh(r, "lot", points, 6, counts, 1, corners), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_output_count(r, 1), 2);
    CHECK_NUMBER(pcg_run_mesh(r, 1, 0, &view), PCG_STATUS_OK);
    CHECK_NUMBER(view.point_count, 6);
    CHECK_NUMBER(view.face_count, 2);
    CHECK_NUMBER(view.corner_count, 8);
    for (size_t i = 0; i < view.corner_count; i++)
        for (size_t k = 0; k < 3; k++)
            CHECK_NUMBER(view.points[3 * view.corner_points[i] + k], points[3 * corners[i] + k]);
    CHECK_NUMBER(pcg_run_mesh(r, 1, 1, &view), PCG_STATUS_OK);
    CHECK_NUMBER(view.face_count, 1);
    pcg_run_free(r);
}

typedef struct refused {
    const char *gate;
    const double *points;
    size_t point_count;
    const uint32_t *counts;
    size_t face_count;
    const uint32_t *corners;
    const char *why;
} refused;

static void refuses_what_makes_no_sense(void)
{
    static const double endless[] = {0, 0, 0, 1, 0, 0, 1, HUGE_VAL, 0},
                        no_number[] = {0, 0, 0, 1, 0, (double)NAN, 1, 1, 0};
    static const uint32_t two[] = {2}, three[] = {3}, none[] = {0}, huge[] = {UINT32_MAX},
                          far[] = {0, 1, 6};
    const refused all[] = {
        {"plot", points, 6, counts, 2, corners, "graph 'toy' has no input 'plot'"},
        {"net", points, 6, counts, 2, corners, "input 'net' takes StreetNetwork, not a shape"},
        {"lot", NULL, 6, counts, 2, corners, "there are 6 points, but points is NULL"},
        {"lot", points, SIZE_MAX / 2, counts, 2, corners,
         "9223372036854775807 points are too many"},
        {"lot", endless, 3, three, 1, corners, "point 2 has no finite position"},
        {"lot", no_number, 3, three, 1, corners, "point 1 has no finite position"},
        {"lot", points, 6, NULL, 2, corners, "there are 2 faces, but counts is NULL"},
        {"lot", points, 6, counts, 2, NULL, "there are 2 faces, but corners is NULL"},
        {"lot", points, 6, counts, 0, corners, "a shape needs a face"},
        {"lot", points, 6, two, 1, corners, "face 0 has 2 corners, a face needs 3"},
        {"lot", points, 6, none, 1, corners, "face 0 has 0 corners, a face needs 3"},
        {"lot", points, 6, huge, 1, corners, "the faces have too many corners"},
        {"lot", points, 6, three, 1, far, "face 0 has a corner at point 6, there are 6 points"},
        {"lot", points, 3, counts, 2, corners,
         "face 0 has a corner at point 3, there are 3 points"},
        {"lot", NULL, 0, three, 1, corners, "face 0 has a corner at point 0, there are 0 points"},
    };
    pcg_run *r = pcg_run_new(program, NULL);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const refused *x = &all[i];
        CHECK_NUMBER(pcg_run_input_mesh(r, x->gate, x->points, x->point_count, x->counts,
                                        x->face_count, x->corners),
                     PCG_STATUS_MISUSE);
        CHECK_TEXT(pcg_run_error(r), x->why);
    }
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_output_count(r, 1), 2);
    CHECK_NUMBER(pcg_run_input_mesh(r, "lot", points, 6, counts, 2, corners), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "inputs are fed before the run is executed, 'lot' comes too late");
    pcg_run_free(r);
}

int main(void)
{
    program = pcg_program_of(&toy_module);
    comes_out_as_it_went_in();
    refuses_what_makes_no_sense();
    pcg_program_free(program);
    return unit_done();
}
