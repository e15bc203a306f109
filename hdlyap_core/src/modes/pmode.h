/** How P modes are reconstructed. */
#ifndef HD_PMODE_H
#define HD_PMODE_H

#include "hdlyap/pmode.h"

/** For the particles of a scene. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_pmode_create(hd_pmode **out, const hd_scene_def *def);
void hd_pmode_free(hd_pmode *pmode);

double hd_pmode_bytes(const hd_scene_def *def);

#endif
