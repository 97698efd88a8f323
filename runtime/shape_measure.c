/* shape_measure.c - normals, areas and volumes. */
#include "runtime/mesh.h"

/* Newell's normal of one loop, about a point near it. */
static pcg_vec3 loop_normal(const pcg_shape *s, uint32_t loop, pcg_vec3 about)
{
    const pcg_mesh *m = s->mesh;
    uint32_t first = m->loop_corner[loop], end = m->loop_corner[loop + 1];
    pcg_vec3 sum = vec3(0, 0, 0), before;

    if (end - first < 3)
        return sum;
    before = vec3_subtract(shape_corner(s, end - 1), about);
    for (uint32_t i = first; i < end; i++) {
        pcg_vec3 here = vec3_subtract(shape_corner(s, i), about);

        sum = vec3_add(sum, vec3_cross(before, here));
        before = here;
    }
    return sum;
}

pcg_vec3 pcg_shape_face_normal(const pcg_shape *s, uint32_t face)
{
    const pcg_mesh *m = s->mesh;
    pcg_vec3 sum = vec3(0, 0, 0), about;

    if (face_first_corner(m, face) == face_last_corner(m, face))
        return sum;
    about = shape_corner(s, face_first_corner(m, face));
    for (uint32_t l = m->face_loop[face]; l < m->face_loop[face + 1]; l++)
        sum = vec3_add(sum, loop_normal(s, l, about));
    return sum;
}

double pcg_shape_area(const pcg_shape *s)
{
    double area = 0;

    for (uint32_t f = 0; f < s->mesh->face_count; f++)
        area += vec3_length(pcg_shape_face_normal(s, f)) / 2;
    return area;
}

/* Six times the signed volume between a point and a loop's fan. */
static double loop_volume(const pcg_shape *s, uint32_t loop, pcg_vec3 about)
{
    const pcg_mesh *m = s->mesh;
    uint32_t first = m->loop_corner[loop], end = m->loop_corner[loop + 1];
    double sum = 0;

    if (end - first < 3)
        return 0;
    pcg_vec3 apex = vec3_subtract(shape_corner(s, first), about);
    pcg_vec3 before = vec3_subtract(shape_corner(s, first + 1), about);
    for (uint32_t i = first + 2; i < end; i++) {
        pcg_vec3 here = vec3_subtract(shape_corner(s, i), about);

        sum += vec3_dot(apex, vec3_cross(before, here));
        before = here;
    }
    return sum;
}

double pcg_shape_volume(const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    double sum = 0;
    pcg_vec3 about;

    if (m->vertex_count == 0)
        return 0;
    about = shape_point(s, 0);
    for (uint32_t l = 0; l < m->loop_count; l++)
        sum += loop_volume(s, l, about);
    return sum / 6;
}

uint32_t pcg_shape_holes(const pcg_shape *s)
{
    uint32_t holes = 0;

    for (uint32_t f = 0; f < s->mesh->face_count; f++) {
        uint32_t loops = s->mesh->face_loop[f + 1] - s->mesh->face_loop[f];

        holes += loops > 1 ? loops - 1 : 0;
    }
    return holes;
}
