/** The T, L and P fields of every wave vector, sampled at the disks [T10], [T22]. Several threads
 * may read one at once while its run is not called. */
#ifndef HDLYAP_FIELDS_H
#define HDLYAP_FIELDS_H

#include "hdlyap/wave.h"

HD_API_BEGIN

typedef enum hd_mode_kind { HD_MODE_NONE, HD_MODE_ZERO, HD_MODE_T, HD_MODE_LP } hd_mode_kind;

/** The fields of one kind at one wave vector: columns [column, column + dimension). Of an LP
 * subspace the first half are the L fields, the second half the P fields of the same modulations.
 */
typedef struct hd_subspace {
    hd_mode_kind kind; /**< HD_MODE_T or HD_MODE_LP */
    hd_wave wave;
    hd_modulations modulations;
    int column, dimension; /**< dimension = expected multiplicity of the step */
} hd_subspace;

typedef struct hd_fields hd_fields;
int hd_fields_stride(const hd_fields *fields); /**< doubles from one row to the next */
/** Row-major, a row for each coordinate of each disk: x, y, .., and behind them what is no place,
 * where P alone has something. */
const double *hd_fields_data(const hd_fields *fields);

int hd_fields_subspaces(const hd_fields *fields);
const hd_subspace *hd_fields_subspace(const hd_fields *fields, int s);

HD_API_END
#endif
