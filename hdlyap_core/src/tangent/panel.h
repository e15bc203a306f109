/** Panels of an orthonormalisation [T7]: whatever the number of ranks, each of which has some of
 * the rows. */
#ifndef HD_PANEL_H
#define HD_PANEL_H

#include "tangent/frame.h"
#include "tangent/ortho.h"
#include "tangent/ortho_state.h"

/** A panel wider than HD_LEAF_MAX is orthonormalised by halves. S is of HD_LATER_MAX vectors at
 * most, for the sake of its room. */
enum { HD_LEAF_MAX = 48, HD_LATER_MAX = 704 };

/** Some neighbouring vectors: the panel whose turn it is, a part of it, or later ones. */
typedef struct hd_panel {
    double *a; /**< its rows of A */
    int lda, first, width;
} hd_panel;

/** Some vectors from `first` on, side by side: where they are, or, if they are of several ranks, a
 * copy of them in the room for one panel. */
hd_panel hd_panel_load(hd_ortho *ortho, hd_frame *frame, int first, int width);
/** The copy, if it is one, goes back to where the vectors are. */
void hd_panel_store(const hd_ortho *ortho, hd_frame *frame, hd_panel x);

/** Of the equal pieces, of HD_LATER_MAX vectors at most, that so many later ones are dealt with in.
 */
int hd_panel_later_width(int later);

/** s[count * x.width] <- A_y A_x^T of all ranks, in the norm, column-major: y are `count` vectors
 * from `first` on, wherever they are. */
void hd_panel_products(hd_ortho *ortho, hd_frame *frame, double *s, int first, int count,
                       hd_panel x);

/** x <- orthonormal; its logarithms and its part of the probes are then known. HD_ILL_CONDITIONED.
 */
HD_MUST_CHECK hd_status hd_panel_orthonormalise(hd_ortho *ortho, hd_panel x);

/** Takes it out of all later vectors, and out of their probes. */
void hd_panel_project_out(hd_ortho *ortho, hd_frame *frame, hd_panel x);

#endif
