/* overlaps.c - which pieces of a band overlap, and by how much of their lengths. */
#include <math.h>

#include "layout.h"
#include "pairs.h"

/* Less than this, in square metres, is rounding. */
static const double least_area = 1e-11;

enum { CLIP_MAX = 16 }; /* a quadrilateral that is cut by four lines has ten corners at most */

typedef struct outline {
    pcg_vec2 at[CLIP_MAX];
    uint32_t count;
} outline;

typedef struct finder {
    layout *l;
    int band;
    const uint32_t *piece; /* of each box: its first point */
} finder;

/* The corners of a piece, counter-clockwise, about a place. Borders are on a grid: nothing is
 * rounded, and what follows is the more exact. */
static outline piece_outline(const layout *l, int band, uint32_t piece, pcg_vec2 about)
{
    const pcg_vec2 *left = l->border[band][LEFT], *right = l->border[band][RIGHT];

    return (outline){{vec2_subtract(right[piece], about), vec2_subtract(right[piece + 1], about),
                      vec2_subtract(left[piece + 1], about), vec2_subtract(left[piece], about)},
                     4};
}

static double turn_of(pcg_vec2 a, pcg_vec2 b, pcg_vec2 c)
{
    return vec2_cross(vec2_subtract(b, a), vec2_subtract(c, a));
}

/* The part of an outline on the left of a line. */
static outline clip(const outline *o, pcg_vec2 a, pcg_vec2 b)
{
    outline kept = {.count = 0};

    for (uint32_t i = 0, j = o->count - 1; i < o->count; j = i++) {
        double before = turn_of(a, b, o->at[j]), here = turn_of(a, b, o->at[i]);

        if ((before < 0 && here > 0) || (before > 0 && here < 0))
            kept.at[kept.count++] = vec2_between(o->at[j], o->at[i], before / (before - here));
        if (here >= 0)
            kept.at[kept.count++] = o->at[i];
        if (kept.count > CLIP_MAX - 2)
            break;
    }
    return kept;
}

static double area_of(const outline *o)
{
    double sum = 0;

    for (uint32_t i = 2; i < o->count; i++)
        sum += turn_of(o->at[0], o->at[i - 1], o->at[i]);
    return sum / 2;
}

/* Which share of a piece's length the cross-section through a point leaves behind. */
static double share_at(const outline *piece, pcg_vec2 at)
{
    pcg_vec2 from = vec2_subtract(piece->at[3], piece->at[0]);
    pcg_vec2 widening = vec2_subtract(vec2_subtract(piece->at[2], piece->at[1]), from);
    pcg_vec2 along = vec2_subtract(piece->at[1], piece->at[0]);
    pcg_vec2 to = vec2_subtract(at, piece->at[0]);
    double a = -vec2_cross(widening, along), c = vec2_cross(from, to);
    double b = vec2_cross(widening, to) - vec2_cross(from, along);
    double root = b * b - 4 * a * c, q, first, second;

    root = root > 0 ? sqrt(root) : 0;
    q = -(b + (b < 0 ? -root : root)) / 2;
    first = a != 0 ? q / a : -1;
    second = q != 0 ? c / q : -1;
    if (!(second >= -1e-9 && second <= 1 + 1e-9))
        second = first;
    return second > 0 ? (second < 1 ? second : 1) : 0;
}

static void add_shares(const outline *piece, const outline *part, double *low, double *high)
{
    for (uint32_t i = 0; i < part->count; i++) {
        double share = share_at(piece, part->at[i]);

        *low = fmin(*low, share);
        *high = fmax(*high, share);
    }
}

/* What an outline has in common with a convex one. */
static outline common(const outline *o, const pcg_vec2 *with, uint32_t count)
{
    outline part = *o;

    for (uint32_t i = 0, j = count - 1; i < count && part.count > 2; j = i++)
        part = clip(&part, with[j], with[i]);
    return part;
}

static bool is_convex(const outline *o)
{
    for (uint32_t i = 0; i < 4; i++)
        if (!(turn_of(o->at[i], o->at[(i + 1) % 4], o->at[(i + 2) % 4]) >= 0))
            return false;
    return true;
}

/* A piece that is not convex as two triangles, on either side of the diagonal that is inside. */
static void halve(const outline *o, pcg_vec2 halves[2][3])
{
    uint32_t from =
        turn_of(o->at[0], o->at[1], o->at[2]) >= 0 && turn_of(o->at[0], o->at[2], o->at[3]) >= 0
            ? 0
            : 1;

    for (uint32_t i = 0; i < 3; i++) {
        halves[0][i] = o->at[(from + i) % 4];
        halves[1][i] = o->at[(from + (i > 0 ? i + 1 : 0)) % 4];
    }
}

/* How two pieces overlap; false where they do not. */
static bool overlap_of(const outline *a, const outline *b, overlap *found)
{
    pcg_vec2 halves[2][3];
    bool whole = is_convex(b), any = false;

    halve(b, halves);
    found->low[0] = found->low[1] = 1;
    found->high[0] = found->high[1] = 0;
    for (uint32_t i = 0; i < (whole ? 1u : 2u); i++) {
        outline part = whole ? common(a, b->at, 4) : common(a, halves[i], 3);

        if (part.count < 3 || fabs(area_of(&part)) < least_area)
            continue;
        add_shares(a, &part, &found->low[0], &found->high[0]);
        add_shares(b, &part, &found->low[1], &found->high[1]);
        any = true;
    }
    return any;
}

/* ---- pairs ----------------------------------------------------------------------------------- */

static bool share_node(const street_link *a, const street_link *b)
{
    return a->node[0] == b->node[0] || a->node[0] == b->node[1] || a->node[1] == b->node[0] ||
           a->node[1] == b->node[1];
}

/* Whether two pieces can be in each other's way. Those of one link overlap in each tight bend. */
static bool are_compared(const layout *l, int band, uint32_t p, uint32_t q)
{
    const street_link *a = &l->link[l->link_of[p]], *b = &l->link[l->link_of[q]];
    const street_way *v = &l->way[a->way], *w = &l->way[b->way];
    double gap, width = v->width + (band == CORRIDOR ? v->left + v->right : 0);

    if (a != b)
        return v->level == w->level || share_node(a, b);
    gap = p < q ? l->arc[q] - l->arc[p + 1] : l->arc[p] - l->arc[q + 1];
    return gap > width;
}

static int compare_pieces(void *context, uint32_t s, uint32_t t)
{
    const finder *f = context;
    overlaps *o = &f->l->overlaps[f->band];
    uint32_t p = f->piece[s], q = f->piece[t];
    overlap found = {.piece = {p, q}};
    pcg_vec2 about;
    outline a, b;

    if (!are_compared(f->l, f->band, p, q))
        return PCG_OK;
    about = f->l->border[f->band][LEFT][p];
    a = piece_outline(f->l, f->band, p, about);
    b = piece_outline(f->l, f->band, q, about);
    if (!overlap_of(&a, &b, &found))
        return PCG_OK;
    if (o->count >= UINT32_MAX / 4)
        return pcg_fail(f->l->call, "the streets overlap in too many places");
    if (list_room(f->l->run, (void **)&o->at, &o->capacity, o->count, 1, sizeof *o->at) != PCG_OK)
        return PCG_FAILED;
    o->at[o->count++] = found;
    return PCG_OK;
}

static pair_box box_of(const layout *l, int band, uint32_t piece)
{
    outline o = piece_outline(l, band, piece, (pcg_vec2){0, 0});
    pair_box box = {o.at[0], o.at[0]};

    for (uint32_t i = 1; i < o.count; i++) {
        box.low = (pcg_vec2){fmin(box.low.x, o.at[i].x), fmin(box.low.y, o.at[i].y)};
        box.high = (pcg_vec2){fmax(box.high.x, o.at[i].x), fmax(box.high.y, o.at[i].y)};
    }
    return box;
}

static int compare_all(layout *l, int band, pair_box *box, uint32_t *piece)
{
    finder f = {.l = l, .band = band, .piece = piece};
    uint32_t count = 0;

    for (uint32_t k = 0; k < l->links; k++)
        for (uint32_t i = 0; i < link_last(&l->link[k]); i++) {
            piece[count] = l->link[k].first + i;
            box[count] = box_of(l, band, piece[count]);
            count++;
        }
    return pairs_find(l->call, box, count, compare_pieces, &f);
}

/* ---- by piece -------------------------------------------------------------------------------- */

static int list_by_piece(layout *l, overlaps *o)
{
    o->begin = run_alloc_array(l->run, l->points + (size_t)2, sizeof *o->begin);
    o->of = run_alloc(l->run, (2 * (size_t)o->count + 1) * sizeof *o->of);
    if (o->begin == NULL || o->of == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < 2 * o->count; i++)
        o->begin[o->at[i / 2].piece[i % 2] + 2]++;
    for (uint32_t i = 2; i < l->points + 2; i++)
        o->begin[i] += o->begin[i - 1];
    for (uint32_t i = 0; i < 2 * o->count; i++)
        o->of[o->begin[o->at[i / 2].piece[i % 2] + 1]++] = i;
    return PCG_OK;
}

int layout_find_overlaps(layout *l, int band)
{
    size_t points = l->points + (size_t)1;
    pair_box *box = run_alloc(l->run, points * sizeof *box);
    uint32_t *piece = run_alloc(l->run, points * sizeof *piece);
    int status = box != NULL && piece != NULL ? PCG_OK : PCG_FAILED;

    if (status == PCG_OK)
        status = compare_all(l, band, box, piece);
    if (status == PCG_OK)
        status = list_by_piece(l, &l->overlaps[band]);
    run_free(l->run, box, points * sizeof *box);
    run_free(l->run, piece, points * sizeof *piece);
    return status;
}
