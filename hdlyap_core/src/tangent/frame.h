/** The tangent frame: M x n vectors, M coordinates and momenta of all particles, carried along by
 * replaying a record [T1]-[T4]. */
#ifndef HD_FRAME_H
#define HD_FRAME_H

#include "base/archive.h"
#include "base/communicator.h"
#include "dynamics/dynamics.h"
#include "hdlyap/frame.h"

/** The rows of a particle are its coordinates dq_x, dq_y, .., then dp_x, dp_y, .. Storage is
 * row-major with leading dimension hd_frame_stride; rows are aligned to 64 bytes, and columns that
 * are no vectors are zero. A single rank has all n <= hd_frame_stride vectors; of several ranks
 * each has hd_frame_stride, the last ones fewer. */
typedef struct hd_frame hd_frame;

/** Makes a frame of the particles of *scene, which is copied, with 1 .. M vectors with random
 * entries from the seed, which are not orthonormal yet. */
HD_MUST_CHECK hd_status hd_frame_create(hd_frame **out, const hd_scene_def *scene, int vectors,
                                        uint64_t seed, int threads);
/** Creates a frame of which each rank carries some vectors; all ranks call it together. Fails with
 * HD_NO_MEMORY on all ranks if any of them has too little. */
HD_MUST_CHECK hd_status hd_frame_create_shared(hd_frame **out, const hd_scene_def *scene,
                                               int vectors, uint64_t seed, int threads,
                                               hd_communicator *communicator);
void hd_frame_free(hd_frame *frame);

int hd_frame_rows(const hd_frame *frame);                /**< M */
int hd_frame_coordinates(const hd_frame *frame);         /**< of a particle */
int hd_frame_vectors(const hd_frame *frame);             /**< n, of all ranks together */
int hd_frame_stride(const hd_frame *frame);              /**< doubles from one row to the next */
void hd_frame_use_threads(hd_frame *frame, int threads); /**< 1 .. as many as at its creation */
double *hd_frame_data(hd_frame *frame); /**< the present vectors; valid until the next replay */
const double *hd_frame_read(const hd_frame *frame); /**< the same for reading */
hd_columns hd_frame_columns(const hd_frame *frame); /**< all vectors of this rank */

/** Exchanges entries with the other ranks: until hd_frame_to_columns or a rewind, each rank has all
 * vectors of some particles, in the same memory, instead of some vectors of all particles. */
void hd_frame_to_rows(hd_frame *frame);
void hd_frame_to_columns(hd_frame *frame);
int hd_frame_rows_here(const hd_frame *frame); /**< after it; zeros follow the last particle's */
/** After hd_frame_to_rows: the entry of a vector in the first row; and the number of vectors, with
 * this one, that lie side by side from there on, at the leading dimension hd_frame_stride. */
double *hd_frame_vector(hd_frame *frame, int col);
int hd_frame_neighbours(const hd_frame *frame, int col);

/** Copies `count` vectors, whichever rank has them, to all ranks, row-major: x[M][count]. */
void hd_frame_gather(const hd_frame *frame, int first, int count, double *x);

/** Carries the vectors from t_begin to t_end (times as in the record) through what happened from
 * t_begin to t_end (hd_record_within), and keeps the vectors of t_begin for hd_frame_rewind. All
 * cores; a block of columns stays in cache. HD_NO_MEMORY if the room for the maps could not grow.
 * Cost about 40 n flops and 128 n bytes of cache traffic per pair event. */
HD_MUST_CHECK hd_status hd_frame_replay(hd_frame *frame, const hd_record *record, double t_begin,
                                        double t_end);

/** The vectors as they were before the last replay; valid until the next one. */
const double *hd_frame_before(const hd_frame *frame);
/** Undoes the last replay (once). */
void hd_frame_rewind(hd_frame *frame);

/** For each of this rank's columns (hd_frame_columns): the cosine of the angle between its dp and
 * dq halves, NaN if one of them vanishes; and |dp| / |dq|, NaN if dq vanishes. */
void hd_frame_dq_dp(const hd_frame *frame, double *cos_theta, double *dp_dq_ratio);

/** Reads or writes the frame. With several ranks each one reads the whole file; when writing, rank
 * 0 gets the vectors of all. Fails with HD_NO_MEMORY on all ranks. */
HD_MUST_CHECK hd_status hd_frame_archive(hd_frame *frame, hd_archive *archive);
/** Numbers that it reads or writes. */
double hd_frame_archived(const hd_dynamics *of, int particles, int vectors);
/** Bytes of a frame of this many vectors on one rank, without its tangent maps. */
double hd_frame_bytes(const hd_dynamics *of, double rows, double vectors, double threads);

/** frame.c keeps the members, replay.c carries the vectors. */
struct hd_frame {
    hd_communicator *communicator; /**< NULL: a single rank, which has all vectors */
    hd_scene_def scene;            /**< for `carry`, and whoever makes its maps */
    const hd_dynamics *of;
    int particles, rows, vectors, stride;
    int rows_kept; /**< rows with the zeros that make all ranks' parts equal */
    bool by_rows;
    int threads, threads_max;
    int width;       /**< width of a block: 1, 2, 4, 8, 16, 32 or 64 columns */
    double *copy[2]; /**< [rows * stride]: the vectors before and after a replay */
    int current;
    double *buffer; /**< [threads][rows * width] */
    void *maps;     /**< the tangent maps of the present replay; the dynamics knows what they are */
};

#endif
