/** The L and P modes of an LP step, each reconstructed from all vectors of the step [T14]. The
 * functions of one run share a workspace: only one thread at a time may call them for the same run.
 * [T14] is the tag of an equation in THEORY.md. */
#ifndef HDLYAP_PMODE_H
#define HDLYAP_PMODE_H

#include "hdlyap/frame.h"
#include "hdlyap/steps.h"

HD_API_BEGIN

/** The modes of the step that was reconstructed last; owned by the run. */
typedef struct hd_pmode hd_pmode;

/** Finds the combinations of a step's vectors that come nearest to its fields: phi = psi Q, with
 * psi the dq halves of the vectors scaled to length 1, and Q such that the columns of phi are the
 * least-squares projections of the L and P fields of length 1. `vectors` must contain the step's
 * columns (hd_run_vectors_now when fields are due), `modes` those of the same run. Returns false,
 * and nothing below may be read, without vectors, and unless the step is a resolved LP step that
 * shares its set with no other step. */
bool hd_pmode_reconstruct(hd_pmode *pmode, const hd_step *step, const hd_modes *modes,
                          hd_columns vectors);

/** Number d of pairs of an L and a P mode, which is that of the modulations. */
int hd_pmode_pairs(const hd_pmode *pmode);
/** Mode c as [particle][coordinates], 0 <= c < 2 d: first the L mode of each pair, then the P mode
 * of each pair. It is valid until the next reconstruction. */
const double *hd_pmode_field(const hd_pmode *pmode, int c);
/** How far field c, of length 1, is from the space that the vectors span: 0 (inside) .. 1
 * (orthogonal). */
double hd_pmode_residual(const hd_pmode *pmode, int c);
/** Largest |s - 1| of the singular values s of Q: how far Q is from a rotation. */
double hd_pmode_rotation_distance(const hd_pmode *pmode);

/** Divides P mode c, d <= c < 2 d, by the momenta p[particle][coordinates], component by component:
 * out = s phi p / (p^2 + eps), out[particle][coordinates], with s the length that the P field p A
 * had before it was scaled to 1. All components of out are then the modulation A at the particle,
 * with amplitude 1 but for eps and for what hd_pmode_residual says. */
void hd_pmode_divide(const hd_pmode *pmode, double *out, int c, const double *p);

/** eps of hd_pmode_divide, in units of the mean square of a momentum component. */
#define HD_PMODE_EPSILON 1e-2

HD_API_END
#endif
