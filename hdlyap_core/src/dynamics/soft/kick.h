/** Entries of a record of soft particles. Each time step writes an entry that begins it, then its
 * kicks in their order. All have the time at which the time step ends, so that no part of a record
 * cuts it in two. */
#ifndef HD_KICK_H
#define HD_KICK_H

/** Number of second derivatives of a pair's potential: xx, xy, yy; in space xx, xy, xz, yy, yz,
 * zz. */
enum { HD_BENDS_PLANE = 3, HD_BENDS_SPACE = 6 };

/** A pair in a kick, or the beginning of a time step if i = -1. i and j are whole numbers, kept as
 * doubles as all else is. */
typedef struct hd_kick {
    double t;      /**< end of the time step, since the start of the record [time units] */
    double i, j;   /**< particles, i < j */
    double at;     /**< time of the kick in the time step; if i = -1, length of the time step */
    double bend[]; /**< [HD_BENDS_..]: second derivatives times the kick's part of the time step */
} hd_kick;

#define HD_KICK_BYTES(bends) ((4 + (bends)) * sizeof(double))

#endif
