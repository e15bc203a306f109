/** The T, L and P fields of every wave vector at the particles [T10], [T22]. Several threads may
 * read one hd_fields at once while none calls its run. */
#ifndef HDLYAP_FIELDS_H
#define HDLYAP_FIELDS_H

#include "hdlyap/wave.h"

HD_API_BEGIN

typedef enum hd_mode_kind { HD_MODE_NONE, HD_MODE_ZERO, HD_MODE_T, HD_MODE_LP } hd_mode_kind;

/** The fields of one kind at one wave vector: columns [column, column + dimension) of the matrix of
 * fields. In an LP subspace the L fields of all modulations come first, then the P fields. */
typedef struct hd_subspace {
    hd_mode_kind kind; /**< HD_MODE_T or HD_MODE_LP */
    hd_wave wave;
    hd_modulations modulations;
    int column;    /**< the first column of the matrix of fields that belongs to it */
    int dimension; /**< number of its columns, which is the expected multiplicity of the step */
} hd_subspace;

typedef struct hd_fields hd_fields;
int hd_fields_stride(const hd_fields *fields); /**< doubles from one row to the next */
/** The matrix of fields, row by row: a row for each coordinate of each particle, x, y, .. and then
 * coordinates that are no positions, in which only P fields are not 0. */
const double *hd_fields_data(const hd_fields *fields);

int hd_fields_subspaces(const hd_fields *fields);
const hd_subspace *hd_fields_subspace(const hd_fields *fields, int s);

HD_API_END
#endif
