/** Coefficients of integrators. A new integrator takes a row, which is all that other code uses. */
#include "dynamics/soft/integrator.h"

/** Forest and Ruth, Physica D 43, 105 (1990): 1 / (2 - 2^(1/3)). */
#define THETA 1.3512071919596578
/** Position-extended Forest and Ruth: Omelyan, Mryglod and Folk, Comput. Phys. Commun. 146, 188
 * (2002). */
#define XI 0.1786178958448091
#define LAMBDA (-0.2123418310626054)
#define CHI (-0.06626458266981849)

const hd_integrator hd_integrators[HD_INTEGRATORS] = {
    [HD_VERLET] = {"verlet", 2, 1, {0.5, 0.5}, {1.0}, {0.5}, 6.0, 0.4},
    [HD_PEFRL] = {"pefrl",
                  4,
                  4,
                  {XI, CHI, 1.0 - 2.0 * (CHI + XI), CHI, XI},
                  {0.5 - LAMBDA, LAMBDA, LAMBDA, 0.5 - LAMBDA},
                  {XI, XI + CHI, 1.0 - XI - CHI, 1.0 - XI},
                  3.0,
                  0.25},
    [HD_FOREST_RUTH] = {"forest_ruth",
                        4,
                        3,
                        {0.5 * THETA, 0.5 - 0.5 * THETA, 0.5 - 0.5 * THETA, 0.5 * THETA},
                        {THETA, 1.0 - 2.0 * THETA, THETA},
                        {0.5 * THETA, 0.5, 1.0 - 0.5 * THETA},
                        1.5,
                        0.5}};
