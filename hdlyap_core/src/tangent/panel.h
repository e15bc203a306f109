/** Panels of an orthonormalisation [T7], on one or several ranks, each of which has some of the
 * rows. */
#ifndef HD_PANEL_H
#define HD_PANEL_H

#include "tangent/frame.h"
#include "tangent/ortho.h"

/** A panel wider than HD_LEAF_MAX is orthonormalised by halves. S covers at most HD_LATER_MAX
 * vectors, which limits its memory. */
enum { HD_LEAF_MAX = 48, HD_LATER_MAX = 704 };

/** Some neighbouring vectors: the panel whose turn it is, a part of it, or later ones. */
typedef struct hd_panel {
    double *a; /**< its rows of A */
    int lda, first, width;
} hd_panel;

/** Some vectors from `first` on, side by side: the vectors themselves or, if several ranks have
 * them, a copy in the memory for one panel. */
hd_panel hd_panel_load(hd_ortho *ortho, hd_frame *frame, int first, int width);
/** Copies the panel back to its vectors, if it is a copy. */
void hd_panel_store(const hd_ortho *ortho, hd_frame *frame, hd_panel x);

/** Width of the equal pieces, at most HD_LATER_MAX, into which `later` vectors are divided. */
int hd_panel_later_width(int later);

/** s[count * x.width] <- A_y A_x^T over all ranks, in the norm, column-major; y are the `count`
 * vectors from `first` on. */
void hd_panel_products(hd_ortho *ortho, hd_frame *frame, double *s, int first, int count,
                       hd_panel x);

/** Makes x orthonormal, and computes its logarithms and its part of the probes. Fails with
 * HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_panel_orthonormalise(hd_ortho *ortho, hd_panel x);

/** Takes the panel out of all later vectors, and out of their probes. */
void hd_panel_project_out(hd_ortho *ortho, hd_frame *frame, hd_panel x);

#endif
