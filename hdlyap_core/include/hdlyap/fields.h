/** The T, L and P fields of waves, evaluated at the particles [T10], [T22]: patterns of
 * displacement that Lyapunov modes resemble. T fields are transverse waves, L fields longitudinal
 * ones, P fields momenta times a modulation (hdlyap/wave.h). L and P fields of one wave vector
 * together are one kind, LP. Several threads may read one hd_fields at once while no thread calls
 * its run. Tags as [T10] are those of equations in THEORY.md. */
#ifndef HDLYAP_FIELDS_H
#define HDLYAP_FIELDS_H

#include "hdlyap/wave.h"

HD_API_BEGIN

/** The kind of a subspace, a step or a vector: none is known; zero mode; T; LP. */
typedef enum hd_mode_kind { HD_MODE_NONE, HD_MODE_ZERO, HD_MODE_T, HD_MODE_LP } hd_mode_kind;

/** A subspace: the fields of one kind at one wave vector, which are columns column .. column +
 * dimension - 1 of the matrix of fields. In an LP subspace the L fields of all modulations come
 * first, then the P fields in the same order. */
typedef struct hd_subspace {
    hd_mode_kind kind; /**< HD_MODE_T or HD_MODE_LP */
    hd_wave wave;
    /** The modulation of each T field, or of each L field and of the P field that belongs to it. In
     * space a modulation of T fields can occur twice, then the second time with HD_SECOND. */
    hd_modulations modulations;
    int column;    /**< the first column of the matrix of fields that belongs to it */
    int dimension; /**< number of its columns, which is the number of equal exponents expected of
                      its step */
} hd_subspace;

/** The fields of all subspaces at the last sample; owned by the run. */
typedef struct hd_fields hd_fields;
/** Distance of two rows of hd_fields_data in doubles. */
int hd_fields_stride(const hd_fields *fields);
/** The matrix of fields, row by row: one row for each coordinate of each particle, in the order x,
 * y, .. of the particle and then coordinates that are no positions, where only P fields are not 0.
 * Its contents change when the run goes on. */
const double *hd_fields_data(const hd_fields *fields);

/** Number of subspaces, T and LP of each wave that the scene asks for. */
int hd_fields_subspaces(const hd_fields *fields);
/** Subspace s, 0 .. hd_fields_subspaces - 1. */
const hd_subspace *hd_fields_subspace(const hd_fields *fields, int s);

HD_API_END
#endif
