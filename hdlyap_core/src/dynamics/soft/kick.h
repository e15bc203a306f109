/** Entries of a record of soft particles. Each step writes what begins it, then its kicks in their
 * order, all at the time at which it ends: so it is never cut in two. */
#ifndef HD_KICK_H
#define HD_KICK_H

/** Second derivatives of a pair's potential, times the part of the step that its kick stands for:
 * xx, xy, yy, in space xx, xy, xz, yy, yz, zz. */
enum { HD_BENDS_PLANE = 3, HD_BENDS_SPACE = 6 };

/** A pair in a kick; all are doubles: i and j are whole numbers. i = -1: a step begins. */
typedef struct hd_kick {
    double t;      /**< at which the step ends, since the start of the record [time units] */
    double i, j;   /**< particles, i < j */
    double at;     /**< when positions are as in this kick, since the step began; of i = -1: when it
                      ends */
    double bend[]; /**< [HD_BENDS_..] */
} hd_kick;

#define HD_KICK_BYTES(bends) ((4 + (bends)) * sizeof(double))

#endif
