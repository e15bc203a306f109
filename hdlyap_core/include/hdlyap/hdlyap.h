/** Everything: hard disks, their Lyapunov spectrum. */
#ifndef HDLYAP_HDLYAP_H
#define HDLYAP_HDLYAP_H

#include "hdlyap/blas.h"
#include "hdlyap/run.h"

#define HDLYAP_VERSION "0.1.0"

#endif
