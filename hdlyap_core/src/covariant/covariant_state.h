/** Covariant vectors of a run: what covariant.c computes them with, and counts.c which of them are
 * unstable, of the centre or stable. */
#ifndef HD_COVARIANT_STATE_H
#define HD_COVARIANT_STATE_H

#include "averages/doubling.h"
#include "averages/spectrum.h"
#include "covariant/angles.h"
#include "covariant/backward_pair.h"
#include "covariant/covariant.h"
#include "covariant/history.h"
#include "covariant/splitting.h"
#include "modes/modes.h"
#include "tangent/localization.h"

typedef enum way { FORWARD, THROUGH_TRANSIENT, THROUGH_WINDOW } way;

struct hd_covariant {
    hd_scene_def scene;
    int rows, vectors, carried, threads, unstable, centre;
    int centre_most; /**< largest centre for which there is room */
    /** By whose exponents unstable vectors and those of the centre are counted; NULL: theory says
     * how many there are. */
    const hd_spectrum *counting;
    hd_history *past;
    hd_backward_pair
        *starts; /**< two starts through the transient, the first one through the window */
    hd_spectrum *spectrum;
    hd_splitting *splitting;
    hd_doubling *grown; /**< growth of the vectors between two samples, the latest samples first */
    hd_localization *shape;
    hd_modes *half[2]; /**< weights of the dq halves and of the dp halves; NULL without positions in
                          a box */
    /** Weights of the dq halves of the frame at the same times; NULL as `half`. */
    hd_modes *of_frame;
    hd_angles *spaces; /**< angles between spaces of C's rows; it and the next two are NULL if the
                          centre is not computed */
    hd_angles *null;   /**< angles between spaces of the vectors' rows */
    double *null_columns; /**< [2 * centre + HD_NULL_SPARE][rows]: vectors of the centre, then exact
                             null vectors */
    double *factor;       /**< [vectors * vectors]; room for the centres of both starts, too */
    double *coupling;     /**< [carried * carried]; NULL where all vectors are carried */
    double *angle;        /**< [vectors]: principal angles */
    double *apart;  /**< [vectors]: sines between the vectors of both starts at the end of the last
                       window */
    double *edge;   /**< [vectors]: ln |C_ll| at the end of the window */
    double *turned; /**< [vectors]: ln |C_ll| at the beginnings of windows less `edge`, summed */
    double *frame, *q, *p;  /**< vectors [rows * vectors] of a sample; positions and momenta then */
    double window, due;     /**< time at which the window began; time of the next sample */
    double ended;           /**< what hd_covariant_results.window_end says */
    double now, grown_time; /**< time that the forward pass has reached; time of the growth */
    double bytes;           /**< bytes that the window takes */
    way way;
    long at;   /**< interval that is next on the way back */
    long last; /**< interval that the window ends with */
    long windows, lost, intervals;
    uint64_t streams; /**< number of streams of random numbers used so far */
    hd_covariant_mismatch spaces_apart;
    double null_apart, null_apart_most;
};

/* Counts where theory does not say how many vectors each space has (counts.c). */

/** To be counted by the exponents of this spectrum; the spaces are not known yet. */
void hd_covariant_prepare_counting(hd_covariant *covariant, const hd_spectrum *spectrum);
/** Counts the vectors of the spaces. What was measured of other spaces is dropped. */
void hd_covariant_count(hd_covariant *covariant);
/** Reads or writes which spaces the averages are of. */
void hd_covariant_archive_counts(hd_covariant *covariant, hd_archive *archive);

#endif
