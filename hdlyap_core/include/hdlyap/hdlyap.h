/** All public headers of the core, in the order in which data flows: from the scene to the results
 * of a run. Headers of one stage stand together. */
#ifndef HDLYAP_HDLYAP_H
#define HDLYAP_HDLYAP_H

/* base */
#include "hdlyap/blas.h"
#include "hdlyap/communicator.h"
#include "hdlyap/status.h"
/* scene */
#include "hdlyap/scene.h"
#include "hdlyap/parameters.h"
#include "hdlyap/wave.h"
/* averages */
#include "hdlyap/spectrum.h"
/* trajectory */
#include "hdlyap/trajectory.h"
#include "hdlyap/hamiltonian.h"
#include "hdlyap/dynamics_test.h"
#include "hdlyap/gas.h"
/* tangent */
#include "hdlyap/frame.h"
#include "hdlyap/interval.h"
#include "hdlyap/localization.h"
/* modes */
#include "hdlyap/fields.h"
#include "hdlyap/modes.h"
#include "hdlyap/steps.h"
#include "hdlyap/phases.h"
#include "hdlyap/pmode.h"
#include "hdlyap/hydro.h"
#include "hdlyap/structure.h"
/* covariant */
#include "hdlyap/splitting.h"
#include "hdlyap/covariant.h"
/* observe */
#include "hdlyap/averages.h"
#include "hdlyap/fluctuations.h"
#include "hdlyap/observables.h"
/* run */
#include "hdlyap/run.h"
#include "hdlyap/memory_limit.h"
#include "hdlyap/estimate.h"
#include "hdlyap/checkpoint.h"
#include "hdlyap/follow.h"

#define HDLYAP_VERSION "0.1.0"

#endif
