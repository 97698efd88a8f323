/* polygon.c - polygons as growing lists of loops. */
#include "runtime/polygon.h"

#include "runtime/list.h"

int polygons_begin_face(pcg_run *r, polygons *p)
{
    if (list_room(r, (void **)&p->face, &p->face_capacity, p->faces, 1, sizeof *p->face) != PCG_OK)
        return PCG_FAILED;
    p->face[p->faces++] = p->loops;
    return PCG_OK;
}

int polygons_add(pcg_run *r, polygons *p, pcg_vec2 at)
{
    if (list_room(r, (void **)&p->point, &p->point_capacity, p->points, 1, sizeof *p->point) !=
        PCG_OK)
        return PCG_FAILED;
    p->point[p->points++] = at;
    return PCG_OK;
}

int polygons_end_loop(pcg_run *r, polygons *p)
{
    if (list_room(r, (void **)&p->end, &p->loop_capacity, p->loops, 1, sizeof *p->end) != PCG_OK)
        return PCG_FAILED;
    p->end[p->loops++] = p->points;
    return PCG_OK;
}

void polygons_clear(polygons *p)
{
    p->points = p->loops = p->faces = 0;
}

void polygons_free(pcg_run *r, polygons *p)
{
    run_free(r, p->point, p->point_capacity * sizeof *p->point);
    run_free(r, p->end, p->loop_capacity * sizeof *p->end);
    run_free(r, p->face, p->face_capacity * sizeof *p->face);
    *p = (polygons){0};
}

/* Adds the loops of `from` to those of `to`; turned round or as they are. */
static int add_loops(pcg_run *r, polygons *to, const polygons *from, bool turned)
{
    for (uint32_t l = 0; l < from->loops; l++) {
        uint32_t first = loop_begin(from, l), last = from->end[l] - 1;

        for (uint32_t i = first; i <= last; i++)
            if (polygons_add(r, to, from->point[turned ? first + (last - i) : i]) != PCG_OK)
                return PCG_FAILED;
        if (polygons_end_loop(r, to) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

int polygons_subtract(pcg_run *r, const polygons *from, const polygons *without, polygons *out)
{
    polygons both = {0};
    bool changed;
    int status = add_loops(r, &both, from, false);

    if (status == PCG_OK)
        status = add_loops(r, &both, without, true);
    if (status == PCG_OK)
        status = polygons_clean(r, &both, 0, out, &changed);
    polygons_free(r, &both);
    return status;
}

int polygons_intersect(pcg_run *r, const polygons *a, const polygons *b, polygons *out)
{
    polygons both = {0};
    bool changed;
    int status = add_loops(r, &both, a, false);

    if (status == PCG_OK)
        status = add_loops(r, &both, b, false);
    if (status == PCG_OK)
        status = polygons_clean(r, &both, 1, out, &changed);
    polygons_free(r, &both);
    return status;
}

double polygons_loop_area(const polygons *p, uint32_t loop)
{
    uint32_t from = loop_begin(p, loop), to = p->end[loop];
    double sum = 0;

    for (uint32_t i = from, j = to - 1; i < to; j = i++)
        sum += (p->point[j].x - p->point[from].x) * (p->point[i].y - p->point[from].y) -
               (p->point[j].y - p->point[from].y) * (p->point[i].x - p->point[from].x);
    return sum / 2;
}

double polygons_area(const polygons *p)
{
    double sum = 0;

    for (uint32_t l = 0; l < p->loops; l++)
        sum += polygons_loop_area(p, l);
    return sum;
}
