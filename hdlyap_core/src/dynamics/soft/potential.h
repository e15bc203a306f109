/** What two soft particles do to each other, by the square of their distance. */
#ifndef HD_POTENTIAL_H
#define HD_POTENTIAL_H

/** With r from one to the other: the force on the other is -b r, and the second derivatives are b 1
 * + c r r^T [T24]. */
typedef struct hd_pull {
    double v, b, c;
} hd_pull;

typedef struct hd_potential {
    const char *name;
    double cut;   /**< there is none beyond this distance [sigma] */
    int smooth;   /**< derivatives without a jump there */
    double depth; /**< of its well */
    hd_pull (*at)(double square);
} hd_potential;

enum { HD_POWER, HD_WCA, HD_LENNARD_JONES, HD_POTENTIALS };
extern const hd_potential hd_potentials[HD_POTENTIALS];

#endif
