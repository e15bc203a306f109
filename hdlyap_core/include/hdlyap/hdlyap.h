/** Everything: hard disks, their Lyapunov spectrum and modes. */
#ifndef HDLYAP_HDLYAP_H
#define HDLYAP_HDLYAP_H

#include "hdlyap/blas.h"
#include "hdlyap/checkpoint.h"
#include "hdlyap/hydro.h"
#include "hdlyap/parameters.h"
#include "hdlyap/pmode.h"
#include "hdlyap/run.h"

#define HDLYAP_VERSION "0.1.0"

#endif
