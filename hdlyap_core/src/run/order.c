/** Order of rank 0 -> the same order on the other ranks. */
#include "run/order.h"
#include "base/communicator.h"

#include <stdio.h>
#include <string.h>

#include "base/check.h"

/** An order as it is sent. Ranks of another version are refused with the first run; if this struct
 * has another size there, MPI ends them all before. */
typedef struct message {
    int kind, integer, with_scene, with_text;
    double number;
    hd_scene_def scene;
    char particles[HD_PARTICLES]; /**< names the dynamics: a pointer is valid on one rank only */
} message;

void hd_order_tell(hd_communicator *c, hd_order order)
{
    if (!c || !c->leads) return;
    message m = {.kind = (int)order.kind, .integer = order.integer, .number = order.number};
    hd_order_room room = {.text = ""};
    m.with_scene = order.scene != NULL;
    m.with_text = order.text != NULL;
    if (order.scene) {
        m.scene = *order.scene;
        snprintf(m.particles, sizeof m.particles, "%s", hd_dynamics_of(order.scene)->particles);
    }
    if (order.text) strncpy(room.text, order.text, sizeof room.text - 1);
    hd_communicator_broadcast(c, &m, sizeof m);
    if (order.text) hd_communicator_broadcast(c, room.text, sizeof room.text);
}

hd_order hd_order_hear(hd_communicator *c, hd_order_room *room, hd_known known)
{
    message m;
    hd_communicator_broadcast(c, &m, sizeof m);
    if (m.with_text) hd_communicator_broadcast(c, room->text, sizeof room->text);
    room->scene = m.scene;
    if (m.with_scene) HD_ASSERT(hd_dynamics_named(&room->scene.dynamics, m.particles, known));
    return (hd_order){.kind = (hd_order_kind)m.kind,
                      .integer = m.integer,
                      .number = m.number,
                      .scene = m.with_scene ? &room->scene : NULL,
                      .text = m.with_text ? room->text : NULL};
}
