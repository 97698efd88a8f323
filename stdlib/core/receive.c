/*pcg
/// Sends on the entities of messages that were broadcast since it last ran.
///
/// Each node receives each message once, in the order in which they were sent. Entities are references. An
/// entity leaves through the first port whose type it is of, the others through `out`. Where there is no new message
/// nothing leaves: with an edge to its impulse the node looks again each time that one comes.
procedure receive() -> (out: Entity) [stateful] {
    category "messages"
    synonyms "message", "listen", "subscribe", "event", "get", "inbox"
    param message: string /// The name by which it was broadcast.
    /// Those that are shapes.
    augment shape() -> Shape
    /// Those that are faces of shapes, by reference.
    augment face() -> Face
    /// Those that are edges of shapes, by reference.
    augment edge() -> Edge
    /// Those that are vertices of shapes, by reference.
    augment vertex() -> Vertex
    /// Those that are impulses.
    augment impulse() -> Impulse
    /// Those that are groups.
    augment group() -> Group
    example rectangle(width = 2m, height = 3m) -> copy(count = 3) -> broadcast(message = "built");
        r: receive(message = "built") { shape } expect r.shape.area = 18, r.out.count = 0
}
*/
#include "receive.h"
#include "group_entity.h"
#include "runtime/keys.h"
#include "runtime/list.h"
#include "runtime/pool.h"

static const pcg_type *const receive_type[] = {
    [PCG_CORE_RECEIVE_SHAPE] = &pcg_type_shape,
    [PCG_CORE_RECEIVE_FACE] = &pcg_type_face,
    [PCG_CORE_RECEIVE_EDGE] = &pcg_type_edge,
    [PCG_CORE_RECEIVE_VERTEX] = &pcg_type_vertex,
    [PCG_CORE_RECEIVE_IMPULSE] = &pcg_type_impulse,
    [PCG_CORE_RECEIVE_GROUP] = &core_type_group,
};

/* How many messages the node has received, by the number of their name. */
typedef struct receive_state {
    pcg_u32 *received;
    pcg_u32 count, capacity;
} receive_state;

static const pcg_port *receive_port(const struct pcg_core_receive *node, const pcg_entity *e)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        if (pcg_entity_is(e, receive_type[node->items[i].kind])) {
            return node->items[i].port;
        }
    }
    return node->out;
}

/* Where it is counted how many of a name were received; NULL when memory has run out. */
static pcg_u32 *receive_counter(pcg_call *call, pcg_u32 number)
{
    receive_state *s = call->instance->state;
    if (!s) {
        s = call->instance->state = pcg_alloc(call->run, sizeof *s);
    }
    if (!s) {
        return 0;
    }
    pcg_u32 more = number < s->count ? 0 : number - s->count + 1;
    if (list_room(call->run, (void **)&s->received, &s->capacity, s->count, more,
                  sizeof *s->received) != PCG_OK) {
        return 0;
    }
    for (; more; more--) {
        s->received[s->count++] = 0;
    }
    return &s->received[number];
}

int pcg_core_receive(pcg_call *call, struct pcg_core_receive *node)
{
    pcg_frame *owner = pool_outermost(call->frame);
    pcg_u32 number = pool_number(owner, POOL_MESSAGES, node->message);
    if (number == KEYS_NONE) {
        return PCG_OK;
    }
    const pool_list *list = pool_at(owner, POOL_MESSAGES, number);
    pcg_u32 *received = receive_counter(call, number);
    if (!received) {
        return PCG_FAILED;
    }
    while (*received < list->count) {
        pcg_entity *e = list->at[(*received)++];
        PCG_TRY(pool_lend(call, owner, e));
        PCG_TRY(pcg_emit(call, receive_port(node, e), pcg_entity_hold(e)));
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}
