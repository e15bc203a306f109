/** Measures hydrodynamic responses. */
#ifndef HD_HYDRO_H
#define HD_HYDRO_H

#include "hdlyap/frame.h"
#include "hdlyap/hydro.h"

HD_MUST_CHECK hd_status hd_hydro_create(hd_hydro **out, const hd_scene_def *def,
                                        const hd_steps *steps);
void hd_hydro_free(hd_hydro *hydro);
/** As before the first report. */
void hd_hydro_clear(hd_hydro *hydro);

/** Measures responses of the vectors that belong to a resolved step (hd_steps_of_vector), at
 * positions q and momenta p. */
void hd_hydro_measure(hd_hydro *hydro, const hd_steps *steps, hd_columns vectors, const double *q,
                      const double *p);

#endif
