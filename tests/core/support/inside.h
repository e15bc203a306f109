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
PART(const hd_modes, modes)
PART(const hd_steps, steps)
PART(const hd_phases, phases)
PART(const hd_phases, t_phases)
PART(const hd_structure, structure)
PART(const hd_hydro, hydro)
PART(const hd_gas, gas)
PART(hd_localization, localization)
PART(const hd_covariant, covariant)
PART(hd_pmode, pmode)
#undef PART

#endif
