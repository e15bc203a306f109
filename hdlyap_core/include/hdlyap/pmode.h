/** The L and P modes of a step, reconstructed from all its vectors [T14]. One thread at a time. */
#ifndef HDLYAP_PMODE_H
#define HDLYAP_PMODE_H

#include "hdlyap/frame.h"
#include "hdlyap/steps.h"

HD_API_BEGIN

typedef struct hd_pmode hd_pmode;

/** Combines the normalised dq halves psi of the step's vectors to modes phi = psi Q that are
 * nearest to the normalised L and P fields, by least squares. Returns false unless the step is a
 * resolved LP step that shares its set with no other step. */
bool hd_pmode_reconstruct(hd_pmode *pmode, const hd_step *step, const hd_modes *modes,
                          hd_columns vectors);

int hd_pmode_pairs(const hd_pmode *pmode); /**< number d of pairs of modes */
/** Mode c, [particle][coordinates]: for c < d the L mode of pair c, then the P mode of pair c - d.
 */
const double *hd_pmode_field(const hd_pmode *pmode, int c);
/** Distance, 0 .. 1, of normalised field c from the space that the vectors span. */
double hd_pmode_residual(const hd_pmode *pmode, int c);
/** Largest deviation of a singular value of Q from 1: how far Q is from a rotation. */
double hd_pmode_rotation_distance(const hd_pmode *pmode);

/** Divides P mode c by the momenta p, component by component: phi p / (p^2 + eps). All components
 * of out are then the modulation A, of amplitude 1 but for eps and the residual. */
void hd_pmode_divide(const hd_pmode *pmode, double *out, int c, const double *p);

/** eps in units of the mean square of a momentum component. */
#define HD_PMODE_EPSILON 1e-2

HD_API_END
#endif
