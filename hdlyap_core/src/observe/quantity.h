/** A number with a standard error, by which a run can be ended (run/target.c): what a scene must
 * have for it, and what a run states of it. Rows of observables have theirs. */
#ifndef HD_QUANTITY_H
#define HD_QUANTITY_H

#include <stdbool.h>

#include "hdlyap/observables.h"
#include "hdlyap/steps.h"

enum { HD_WHY = 160 };

/** Error negative while not known. */
typedef struct hd_stated {
    double value, error;
    double open; /**< part of the error that no averaging takes away */
} hd_stated;

/** One of a target. */
typedef struct hd_aim {
    const struct hd_quantity *quantity;
    int row;                      /**< whose it is (hd_observed); -1: of the exponents alone */
    int number[HD_DIMENSION_MAX]; /**< nodes of a step, or an index */
    int count;                    /**< of numbers */
    double wanted;                /**< standard error, or if relative its part of the value */
    bool relative;
} hd_aim;

typedef struct hd_quantity {
    const char *name;
    enum { HD_OF_NOTHING, HD_OF_INDEX, HD_OF_NODES } of; /**< whose numbers stand behind the name */
    hd_mode_kind kind;
    /** False if such a scene never knows it, with the reason; NULL: no more is to be asked. */
    bool (*possible)(const hd_scene_def *def, const hd_aim *aim, char why[HD_WHY]);
    hd_stated (*read)(const hd_parts *parts, const hd_aim *aim);
} hd_quantity;

/** All of an observable, up to one without a name; and as a user calls it. */
typedef struct hd_quantities {
    const char *from;
    const hd_quantity *each;
} hd_quantities;

#endif
