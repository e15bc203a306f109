/** How vectors of the frame, the tangent vectors that a run carries, are handed to the caller. */
#ifndef HDLYAP_FRAME_H
#define HDLYAP_FRAME_H

/** Vectors first .. first + count - 1 of a run as columns of a matrix that is stored row by row.
 * Number r of the components of vector first + c is data[r * stride + c]. The components of each
 * particle follow each other, its dq before its dp: dq_x, dq_y, dp_x, dp_y for disks. */
typedef struct hd_columns {
    const double *data;
    int stride; /**< distance of two rows in doubles */
    int first, count;
} hd_columns;

#endif
