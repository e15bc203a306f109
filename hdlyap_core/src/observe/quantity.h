/** A number with a standard error that a target can name to end a run (run/target.c): what a scene
 * needs for it, and what a run states. Rows of observables have tables of them. */
#ifndef HD_QUANTITY_H
#define HD_QUANTITY_H

#include <stdbool.h>

#include "hdlyap/observables.h"
#include "hdlyap/steps.h"

enum { HD_WHY = 160 };

/** The error is negative while it is not known. */
typedef struct hd_stated {
    double value, error;
    double open; /**< part of the error that averaging does not reduce */
} hd_stated;

/** One quantity of a target. */
typedef struct hd_aim {
    const struct hd_quantity *quantity;
    int row;                      /**< its observable (hd_observed); -1: the exponents alone */
    int number[HD_DIMENSION_MAX]; /**< nodes of a step, or an index */
    int count;                    /**< of numbers */
    double wanted;                /**< largest standard error; if relative, a part of the value */
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

/** All quantities of an observable, up to one without a name; and the name of the observable. */
typedef struct hd_quantities {
    const char *from;
    const hd_quantity *each;
} hd_quantities;

#endif
