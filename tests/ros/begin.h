/** A run as the node begins it, without a master: by its own functions, in their order. */
#ifndef HDLYAP_BEGIN_H
#define HDLYAP_BEGIN_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap_ros/params.h"
#include "hdlyap_ros/publisher.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Reads the parameters, creates the run and publishes its run_info; false with the line that
 * refuses one of them. tiny: the run is of two disks instead, for what run_info says of the
 * parameters alone. */
bool begin_run(const hdr_params *params, bool tiny, char *line, size_t size);

/** What diagnostics tell of a node whose topics are behind as these. */
hdr_lag worst_of(hdr_lag *each, int count);

#ifdef __cplusplus
}
#endif
#endif
