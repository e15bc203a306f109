/** The averages of covariant vectors in a checkpoint. */
#ifndef HD_COVARIANT_ARCHIVED_H
#define HD_COVARIANT_ARCHIVED_H

#include "base/archive.h"
#include "covariant/splitting.h"
#include "hdlyap/covariant.h"

void hd_covariant_archive(hd_covariant *covariant, hd_archive *archive);
void hd_splitting_archive(hd_splitting *splitting, hd_archive *archive);

#endif
