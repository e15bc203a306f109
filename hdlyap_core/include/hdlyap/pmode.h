/** The L and P modes of a step, reconstructed from its measured vectors, as the paper does [T14].
 * One thread at a time. */
#ifndef HDLYAP_PMODE_H
#define HDLYAP_PMODE_H

#include "hdlyap/frame.h"
#include "hdlyap/steps.h"

HD_API_BEGIN

typedef struct hd_pmode hd_pmode;

/** Best combinations of the normalised dq halves psi of the step's set for its normalised fields:
 * (phi_L, phi_P) = psi Q by least squares. False if the step is no resolved LP step of its own
 * (shares its set). */
bool hd_pmode_reconstruct(hd_pmode *pmode, const hd_step *step, const hd_modes *modes,
                          hd_columns vectors);

int hd_pmode_pairs(const hd_pmode *pmode); /**< d */
/** phi_L of pair c for c < d, phi_P of pair c - d beyond; [disk][coordinates] */
const double *hd_pmode_field(const hd_pmode *pmode, int c);
/** |phi - field|: distance of field c from what the vectors span, 0 .. 1. */
double hd_pmode_residual(const hd_pmode *pmode, int c);
/** Largest deviation of a singular value of Q (2d x 2d: of vectors on fields) from 1: its distance
 * from a rotation. */
double hd_pmode_rotation_distance(const hd_pmode *pmode);

/** P field divided by the momenta, phi p / (p^2 + eps) component by component, of momenta p: all
 * components are the modulation A itself, of amplitude 1 but for what the residual and eps take
 * away. out as a field. */
void hd_pmode_divide(const hd_pmode *pmode, double *out, int c, const double *p);

/** eps in units of the mean square of a momentum component. */
#define HD_PMODE_EPSILON 1e-2

HD_API_END
#endif
