/** All that the library hides and tests look at. */
#ifndef HD_INSIDE_H
#define HD_INSIDE_H

#include "base/blas.h"
#include "base/communicator.h"
#include "scene/parameters.h"
#include "scene/scene.h"
#include "scene/wave.h"
#include "averages/spectrum.h"
#include "dynamics/record.h"
#include "dynamics/trajectory.h"
#include "tangent/frame.h"
#include "tangent/localization.h"
#include "tangent/ortho.h"
#include "modes/fields.h"
#include "modes/modes.h"
#include "modes/phases.h"
#include "modes/pmode.h"
#include "modes/steps.h"
#include "modes/structure.h"
#include "covariant/covariant.h"
#include "covariant/splitting.h"
#include "observe/gas.h"
#include "observe/hydro.h"
#include "run/run.h"

/* Parts of a run, by a word each. */
#define PART(type, name)                                                                           \
    static inline type *hd_run_##name(const hd_run *run) { return hd_run_parts(run).name; }
PART(const hd_trajectory, trajectory)
PART(const hd_spectrum, spectrum)
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) PART(result, name)
#include "hdlyap/observables.inc"
#undef PART

#endif
