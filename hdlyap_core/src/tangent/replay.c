/** Record -> tangent vectors carried along.
 *
 * The record is first turned into tangent maps. Then each thread takes a block of columns into a
 * buffer that stays in its cache, [particle][2 coordinates][width], carries it through all maps,
 * and writes it to the second copy of V. So hd_frame_rewind finds the vectors from before, at no
 * cost in time. Parallel over blocks; the result does not depend on the number of threads. */
#include <omp.h>
#include <string.h>

#include "base/check.h"
#include "tangent/frame.h"

/** Copies columns [col, col + used) of V into the buffer, or back. */
static void block_load(const hd_frame *frame, double *buffer, int col, int used)
{
    const double *v = frame->copy[frame->current] + col;
    for (int row = 0; row < frame->rows; row++)
        memcpy(buffer + (size_t)row * (size_t)frame->width, v + (size_t)row * (size_t)frame->stride,
               (size_t)used * sizeof *v);
}

static void block_store(const hd_frame *frame, const double *buffer, int col, int used)
{
    double *v = frame->copy[1 - frame->current] + col;
    for (int row = 0; row < frame->rows; row++)
        memcpy(v + (size_t)row * (size_t)frame->stride, buffer + (size_t)row * (size_t)frame->width,
               (size_t)used * sizeof *v);
}

static void block_replay(const hd_frame *frame, double *buffer, int block)
{
    const int width = frame->width, col = block * width;
    const int used = col + width <= frame->stride ? width : frame->stride - col;
    block_load(frame, buffer, col, used);
    frame->of->carry(frame->maps, buffer, width);
    block_store(frame, buffer, col, used);
}

hd_status hd_frame_replay(hd_frame *frame, const hd_record *record, double t_begin, double t_end)
{
    HD_ASSERT(!frame->by_rows);
    HD_TRY(hd_communicator_agree(frame->communicator,
                                 hd_maps_fill_of(frame->of, frame->maps, record, t_begin, t_end)));
    const int blocks = (frame->stride + frame->width - 1) / frame->width;
    const size_t block_size = (size_t)frame->rows * (size_t)frame->width;
#pragma omp parallel for schedule(dynamic) num_threads(frame->threads) if (frame->threads > 1)
    for (int block = 0; block < blocks; block++)
        block_replay(frame, frame->buffer + block_size * (size_t)omp_get_thread_num(), block);
    frame->current = 1 - frame->current;
    return HD_OK;
}
