/*pcg
/// Sends an entity round a loop a number of times.
///
/// `again` leads into what is to be repeated, which leads back to `in`; `done` goes on. The number of the turn is kept in
/// the attribute that `index` is linked to, from 0, so it goes with the entity through everything that is done in the
/// loop, and with what is made of it. An entity at which that attribute was never written begins at 0; when it
/// leaves through `done` the attribute is at its default again, so that the loop can stand in another one.
procedure for_loop<T: Entity>(in: T) -> (again: T, done: T) [pure, one_to_one] {
    category "flow"
    synonyms "loop", "repeat", "iterate", "times", "for", "cycle"
    param count: int /// How often it is repeated; 0 or less leads to `done` at once.
    attr index: int  /// Read and written: the number of the turn. It must be linked.
    example rectangle(width = 2m, height = 3m)
        -> loop: for_loop(count = 3, index => @turn);
        loop.again -> set { assign(@n, @n + @turn) } -> loop;
        loop.done -> c: condition(@n == 0 + 1 + 2 && @turn == 0) expect c.yes.count = 1
}
*/
#include "for_loop.h"
#include "runtime/run.h"

int pcg_core_for_loop(pcg_call *call, struct pcg_core_for_loop *node)
{
    if (node->index.cell < 0 || node->index.kind != PCG_INT) {
        return pcg_fail(call, "'index' must be linked to an int, which counts the turns: "
                              "for_loop(count = 3, index => @turn)");
    }
    const pcg_cell *turn = pcg_attribute(node->in, node->index.cell);
    pcg_int next = turn ? PCG_INT_ADD(turn->i, 1) : 0;
    if (next < node->count) {
        pcg_set_int(call->run, node->in, &node->index, next);
        return pcg_emit(call, node->again, node->in);
    }
    attributes_unwrite(call->run, node->in, &node->index);
    return pcg_emit(call, node->done, node->in);
}
