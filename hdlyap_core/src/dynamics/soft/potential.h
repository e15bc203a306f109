/** The potentials of two soft particles, as functions of the square of their distance. */
#ifndef HD_POTENTIAL_H
#define HD_POTENTIAL_H

/** A potential v at a distance r. The force on the second particle, with r from the first to it, is
 * -b r, and the second derivatives are b 1 + c r r^T [T24]. */
typedef struct hd_pull {
    double v, b, c;
} hd_pull;

typedef struct hd_potential {
    const char *name;
    double cut;   /**< distance beyond which it vanishes [sigma] */
    int smooth;   /**< s, the number of derivatives without a jump where it is cut */
    double jump;  /**< the jump of derivative s + 1 there, of several the root of their squares */
    double least; /**< least accuracy of the energy for which a time step is chosen */
    double depth; /**< depth of its well */
    hd_pull (*at)(double square);
} hd_potential;

enum { HD_POWER, HD_WCA, HD_LENNARD_JONES, HD_POTENTIALS };
extern const hd_potential hd_potentials[HD_POTENTIALS];

#endif
