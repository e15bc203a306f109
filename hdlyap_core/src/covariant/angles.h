/** Angles between spaces that are spanned by columns of one matrix [T17]. */
#ifndef HD_ANGLES_H
#define HD_ANGLES_H

#include "hdlyap/status.h"

/** Columns first .. first + count - 1 of a column-major C with n rows. */
typedef struct hd_span {
    int first, count;
} hd_span;

/** Workspace for computing angles. */
typedef struct hd_angles hd_angles;

/** Makes it for spaces of at most `widest` dimensions. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_angles_create(hd_angles **out, int rows, int widest);
void hd_angles_free(hd_angles *angles);

/** Principal angles [radians, 0 .. pi / 2], smallest first: angle[min(a.count, b.count)]. The
 * columns may be very oblique, but not zero. Fails with HD_ILL_CONDITIONED if they are dependent or
 * not finite. Cost about 2 n (a^2 + b^2) + 4 n a b + 4 n b^2 flops for dimensions a >= b. */
HD_MUST_CHECK hd_status hd_angles_between(hd_angles *angles, double *angle, const double *c,
                                          hd_span a, hd_span b);

/** The angles of hd_angles_between, between the span of the first `count` coordinates (that of the
 * first columns of an upper triangle) and that of columns b; b.count <= count and <= n - count.
 * Cost about 8 n b^2 flops. */
HD_MUST_CHECK hd_status hd_angles_leading(hd_angles *angles, double *angle, const double *c,
                                          int count, hd_span b);

#endif
