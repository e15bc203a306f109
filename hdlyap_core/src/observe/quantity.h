/** A quantity: a number with a standard error that a target can name to end a run (run/target.c).
 * Rows of observables have tables of the quantities that follow from them. */
#ifndef HD_QUANTITY_H
#define HD_QUANTITY_H

#include <stdbool.h>

#include "hdlyap/observables.h"
#include "hdlyap/steps.h"

enum { HD_WHY = 160 };

/** What a run states of a quantity. The error is negative while it is not known. */
typedef struct hd_stated {
    double value, error;
    double open; /**< part of the error that averaging does not reduce */
} hd_stated;

/** One quantity of a target. */
typedef struct hd_aim {
    const struct hd_quantity *quantity;
    int row;                      /**< its observable (hd_observed); -1: the exponents alone */
    const char *name;             /**< its name; of HD_OF_AVERAGE that of the average */
    int number[HD_DIMENSION_MAX]; /**< mode numbers of a step, a Lyapunov index, or which average */
    int count;                    /**< how many numbers are written behind the name */
    double wanted;                /**< largest standard error; if relative, a part of the value */
    bool relative;
} hd_aim;

typedef struct hd_quantity {
    const char *name;
    /** What the numbers behind the name are: none, a Lyapunov index, or mode numbers.
     * HD_OF_AVERAGE: none, and it stands for all hd_dynamics.average of the row, by their names. */
    enum { HD_OF_NOTHING, HD_OF_INDEX, HD_OF_NODES, HD_OF_AVERAGE } of;
    hd_mode_kind kind;
    /** False, with the reason in why, if a run of this scene never knows the quantity. NULL: it
     * always does. */
    bool (*possible)(const hd_scene_def *def, const hd_aim *aim, char why[HD_WHY]);
    hd_stated (*read)(const hd_parts *parts, const hd_aim *aim);
} hd_quantity;

/** The name of an observable, and its quantities; the last one has no name. */
typedef struct hd_quantities {
    const char *from;
    const hd_quantity *each;
} hd_quantities;

#endif
