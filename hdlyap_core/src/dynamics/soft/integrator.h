/** How a time step is made of drifts and kicks. */
#ifndef HD_INTEGRATOR_H
#define HD_INTEGRATOR_H

/** An integrator: drift[0], kick[0], drift[1], .. drift[kicks], as parts of the time step. They are
 * symmetric: read backwards they are the same. */
enum { HD_KICKS_MAX = 4 };
typedef struct hd_integrator {
    const char *name;
    int order, kicks;
    double drift[HD_KICKS_MAX + 1], kick[HD_KICKS_MAX];
    double at[HD_KICKS_MAX]; /**< sum of drifts before each kick: its time in the time step */
    /** As measured [T24]: a of the longest step that keeps the energy in fluids, and w of the walk
     * of the energy. */
    double angle, walk;
} hd_integrator;

/** HD_INTEGRATOR_AUTO is no row: the potential says which it stands for. */
enum { HD_VERLET, HD_PEFRL, HD_INTEGRATORS, HD_INTEGRATOR_AUTO = HD_INTEGRATORS };
extern const hd_integrator hd_integrators[HD_INTEGRATORS];

#endif
