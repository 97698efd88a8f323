/*pcg
/// Keeps entities by a key, for `load` to send on elsewhere.
///
/// What passes is kept by reference, in order, and goes on as well. It is there for the nodes that run later: in this graph
/// and the graphs that it encapsulates, or further out as `reach` says. Without an edge between them, nodes run in
/// order of appearance: a `load` stands below the `store`.
procedure store<T: Entity>(in: T) -> (out: T) [effect, one_to_one] {
    category "keep"
    synonyms "save", "pool", "remember", "global", "variable", "keep"
    param key: string             /// What it is found by.
    param reach: Reach = inside   /// Where it can be seen.
    example rectangle(width = 2m, height = 3m) -> copy(count = 3) -> store(key = "lots");
        load(key = "lots") -> c: copy(count = 1) expect c.out.count = 3
}
*/
#include "store.h"
#include "runtime/pool.h"

static pcg_frame *store_owner(const pcg_call *call, int reach)
{
    pcg_frame *f = call->frame;
    if (reach == PCG_REACH_EVERYWHERE) {
        return pool_outermost(f);
    }
    return reach == PCG_REACH_AROUND && f->parent ? f->parent : f;
}

int pcg_core_store(pcg_call *call, struct pcg_core_store *node)
{
    pcg_frame *owner = store_owner(call, node->reach);
    PCG_TRY(pool_add(call, owner, POOL_STORED, node->key, node->in));
    return pcg_emit(call, node->out, node->in);
}
