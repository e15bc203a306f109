/** Vectors of the frame. */
#ifndef HDLYAP_FRAME_H
#define HDLYAP_FRAME_H

/** Vectors first .. first + count - 1 as columns of a matrix; data[0] is row 0 of the first. Each
 * particle has as many rows as dq and dp have components, in this order: dq_x, dq_y, dp_x, dp_y for
 * disks. */
typedef struct hd_columns {
    const double *data;
    int stride; /**< doubles from one row to the next */
    int first, count;
} hd_columns;

#endif
