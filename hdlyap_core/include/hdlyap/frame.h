/** Vectors of the tangent frame. */
#ifndef HDLYAP_FRAME_H
#define HDLYAP_FRAME_H

/** Vectors first .. first + count - 1, wherever they are kept: data is the first one's entry of row
 * 0. Rows of each disk: dq_x, dq_y, dp_x, dp_y, of spheres dq_x .. dp_z. */
typedef struct hd_columns {
    const double *data;
    int stride; /**< doubles from one row to the next */
    int first, count;
} hd_columns;

#endif
