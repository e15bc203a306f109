/** A call of a run that rank 0 sends to the other ranks. */
#ifndef HD_ORDER_H
#define HD_ORDER_H

#include "hdlyap/communicator.h"
#include "hdlyap/scene.h"
#include "run/checkpoint_file.h"
#include "scene/dynamics.h"

typedef enum hd_order_kind {
    HD_ORDER_END,
    HD_ORDER_CREATE,
    HD_ORDER_RESUME,
    HD_ORDER_FREE,
    HD_ORDER_ADVANCE,
    HD_ORDER_OBSERVE,
    HD_ORDER_WATCH,
    HD_ORDER_CHANGE,
    HD_ORDER_MEASURE,
    HD_ORDER_RESET,
    HD_ORDER_SAVE
} hd_order_kind;

typedef struct hd_order {
    hd_order_kind kind;
    int integer; /**< stages, a column, a row of the parameters */
    double number;
    const hd_scene_def *scene; /**< NULL: none */
    const char *text;          /**< a path, a value; NULL: none */
} hd_order;

/** Memory for the scene and the text of an order that was received. */
typedef struct hd_order_room {
    hd_scene_def scene;
    char text[HD_CHECKPOINT_PATH];
} hd_order_room;

/** Sends the order to the other ranks if this rank is rank 0; else does nothing. */
void hd_order_tell(hd_communicator *communicator, hd_order order);
/** Waits for the next order. Its scene must have a known dynamics; else it is a bug. */
hd_order hd_order_hear(hd_communicator *communicator, hd_order_room *room, hd_known known);

#endif
