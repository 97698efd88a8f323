/* pairs.c - which boxes of many overlap: a hash table of the cells of grids of all sizes. */
#include "pairs.h"

#include <math.h>

/* Grids have cells of 2^CLASS_LEAST metres, and twice, four times … that size. */
enum { CLASS_LEAST = -16, CLASSES = 56, CELLS_OF_BOX = 4 };

typedef struct cell {
    int64_t x, y;
    uint32_t box;
    uint32_t next; /* number + 1 of the next with the same hash */
} cell;

typedef struct pair_finder {
    pcg_call *call;
    const pair_box *box;
    pair_function *meet;
    void *context;
    uint32_t boxes, slots, cells;
    uint64_t classes; /* a bit for each class that has boxes */
    uint8_t *class_of;
    uint32_t *slot; /* numbers of cells + 1 */
    cell *cell;
} pair_finder;

static uint8_t class_of(const pair_box *b)
{
    double size = fmax(b->high.x - b->low.x, b->high.y - b->low.y);
    int exponent = CLASS_LEAST;

    if (size > 0)
        frexp(size, &exponent); /* size < 2^exponent */
    exponent -= CLASS_LEAST;
    return (uint8_t)(exponent < 0 ? 0 : exponent < CLASSES ? exponent : CLASSES - 1);
}

static int64_t place_in(double at, uint32_t class)
{
    return (int64_t)floor(ldexp(at, -((int)class + CLASS_LEAST)));
}

static uint32_t slot_of(const pair_finder *f, int64_t x, int64_t y, uint32_t class)
{
    uint64_t hash = (uint64_t)x * 0x9E3779B97F4A7C15u ^ (uint64_t)y * 0xC2B2AE3D27D4EB4Fu ^
                    (uint64_t) class * 0xD6E8FEB86659FD93u;

    return (uint32_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32) & (f->slots - 1);
}

static void enter(pair_finder *f, uint32_t box)
{
    const pair_box *b = &f->box[box];
    uint32_t class = f->class_of[box];
    int64_t right = place_in(b->high.x, class), top = place_in(b->high.y, class);

    for (int64_t x = place_in(b->low.x, class); x <= right; x++)
        for (int64_t y = place_in(b->low.y, class); y <= top; y++) {
            uint32_t slot = slot_of(f, x, y, class);

            f->cell[f->cells] = (cell){x, y, box, f->slot[slot]};
            f->slot[slot] = ++f->cells;
        }
}

static bool boxes_overlap(const pair_box *a, const pair_box *b)
{
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y &&
           b->low.y <= a->high.y;
}

/* Two boxes can share several cells: they meet in that of the lower left corner of what they have
 * in common. */
static bool is_first_cell(const pair_box *a, const pair_box *b, uint32_t class, int64_t x,
                          int64_t y)
{
    return place_in(fmax(a->low.x, b->low.x), class) == x &&
           place_in(fmax(a->low.y, b->low.y), class) == y;
}

static int meet_in_cell(pair_finder *f, uint32_t box, uint32_t class, int64_t x, int64_t y)
{
    int status = PCG_OK;

    for (uint32_t at = f->slot[slot_of(f, x, y, class)]; at != 0 && status == PCG_OK;
         at = f->cell[at - 1].next) {
        const cell *c = &f->cell[at - 1];

        if (c->x != x || c->y != y || f->class_of[c->box] != class ||
            (f->class_of[box] == class && c->box <= box) ||
            !boxes_overlap(&f->box[box], &f->box[c->box]) ||
            !is_first_cell(&f->box[box], &f->box[c->box], class, x, y))
            continue;
        status = f->meet(f->context, box, c->box);
        if (status == PCG_OK)
            status = pcg_tick(f->call);
    }
    return status;
}

static int meet_others(pair_finder *f, uint32_t box)
{
    const pair_box *b = &f->box[box];

    for (uint32_t class = f->class_of[box]; class < CLASSES; class ++) {
        if (!(f->classes >> class & 1))
            continue;
        int64_t right = place_in(b->high.x, class), top = place_in(b->high.y, class);

        for (int64_t x = place_in(b->low.x, class); x <= right; x++)
            for (int64_t y = place_in(b->low.y, class); y <= top; y++) {
                int status = meet_in_cell(f, box, class, x, y);

                if (status != PCG_OK)
                    return status;
            }
    }
    return PCG_OK;
}

static int find(pair_finder *f)
{
    int status = PCG_OK;

    for (uint32_t i = 0; i < f->boxes; i++) {
        f->class_of[i] = class_of(&f->box[i]);
        f->classes |= (uint64_t)1 << f->class_of[i];
        enter(f, i);
    }
    for (uint32_t i = 0; i < f->boxes && status == PCG_OK; i++)
        status = meet_others(f, i);
    return status;
}

int pairs_find(pcg_call *call, const pair_box *box, uint32_t count, pair_function *meet,
               void *context)
{
    pair_finder f = {.call = call, .box = box, .meet = meet, .context = context, .boxes = count};
    pcg_run *r = call->run;
    size_t cells = (size_t)count * CELLS_OF_BOX + 1;
    int status = PCG_FAILED;

    for (f.slots = 64; f.slots < count && f.slots < 1u << 30;)
        f.slots *= 2;
    f.class_of = run_alloc(r, count + (size_t)1);
    f.slot = run_alloc_array(r, f.slots, sizeof *f.slot);
    f.cell = run_alloc(r, cells * sizeof *f.cell);
    if (f.class_of != NULL && f.slot != NULL && f.cell != NULL)
        status = find(&f);
    run_free(r, f.class_of, count + (size_t)1);
    run_free(r, f.slot, f.slots * sizeof *f.slot);
    run_free(r, f.cell, cells * sizeof *f.cell);
    return status;
}
