/** Order of rank 0 -> the same order on the other ranks. */
#include "run/order.h"

#include <string.h>

/** As it goes over the wire. Ranks of another version are refused with the first run; where this
 * has another size there, MPI ends them all before. */
typedef struct message {
    int kind, integer, with_scene, with_path;
    double number;
    hd_scene_def scene;
} message;

void hd_order_tell(hd_communicator *c, hd_order order)
{
    if (!c || !c->leads) return;
    message m = {.kind = (int)order.kind, .integer = order.integer, .number = order.number};
    hd_order_room room = {.path = ""};
    m.with_scene = order.scene != NULL;
    m.with_path = order.path != NULL;
    if (order.scene) m.scene = *order.scene;
    if (order.path) strncpy(room.path, order.path, sizeof room.path - 1);
    hd_communicator_broadcast(c, &m, sizeof m);
    if (order.path) hd_communicator_broadcast(c, room.path, sizeof room.path);
}

hd_order hd_order_hear(hd_communicator *c, hd_order_room *room)
{
    message m;
    hd_communicator_broadcast(c, &m, sizeof m);
    if (m.with_path) hd_communicator_broadcast(c, room->path, sizeof room->path);
    room->scene = m.scene;
    return (hd_order){.kind = (hd_order_kind)m.kind,
                      .integer = m.integer,
                      .number = m.number,
                      .scene = m.with_scene ? &room->scene : NULL,
                      .path = m.with_path ? room->path : NULL};
}
