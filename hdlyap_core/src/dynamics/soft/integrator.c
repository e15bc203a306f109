/** Coefficients of integrators. A new integrator takes a row, which is all that other code uses. */
#include "dynamics/soft/integrator.h"

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
                  0.25}};
