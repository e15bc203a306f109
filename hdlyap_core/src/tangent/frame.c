/** Tangent vectors, row-major; the rows of a particle are dq_x dq_y .. dp_x dp_y .. With several
 * ranks each one has some of the columns. For an orthonormalisation it has all columns of some
 * particles instead, in the same memory. */
#include "tangent/frame.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/random.h"

/** A sum of squares below this is not known to rounding: that half counts as zero. */
static const double SQUARE_MIN = DBL_MIN / DBL_EPSILON;

/* ---- creation ------------------------------------------------------------------------------ */

/** Rows of whole cache lines. */
static int padded(int vectors)
{
    int width = 1;
    while (width < vectors && width < 8) width *= 2;
    return (vectors + width - 1) / width * width;
}

/** Chooses how many columns a block has. Particles that move in time steps get wider blocks: their
 * maps are larger than their columns, and wide blocks read them less often. */
static int block_width(const hd_dynamics *of, int rows, int stride)
{
    const int least = of->step ? 16 : 8;
    int width = stride < 8 ? stride : 8;
    while (width < HD_BLOCK_WIDTH_MAX && 2 * width <= stride &&
           (width < least || (size_t)rows * (size_t)width * 2 * sizeof(double) <= HD_BLOCK_BYTES))
        width *= 2;
    return width;
}

double hd_frame_bytes(const hd_dynamics *of, double rows_of_all, double vectors, double threads)
{
    const int rows = (int)rows_of_all, stride = padded((int)ceil(vectors));
    return (2.0 * stride + threads * block_width(of, rows, stride)) * rows * sizeof(double);
}

static hd_status frame_allocate(hd_frame *frame)
{
    const size_t size = (size_t)frame->rows_kept * (size_t)frame->stride;
    for (int k = 0; k < 2; k++)
        if (!(frame->copy[k] = hd_memory_alloc(size, sizeof(double)))) return HD_NO_MEMORY;
    const size_t block = (size_t)frame->rows * (size_t)frame->width;
    frame->buffer = hd_memory_alloc(block * (size_t)frame->threads, sizeof(double));
    return frame->buffer ? hd_maps_create_of(&frame->maps, &frame->scene) : HD_NO_MEMORY;
}

/** Number of items of a rank if `all` are shared equally; the last ranks may have fewer. */
static int part_of(const hd_frame *frame, int all)
{
    const int ranks = hd_communicator_ranks(frame->communicator);
    return (all + ranks - 1) / ranks;
}

/** Draws the entries of the whole frame from the seed, and keeps those of this rank's columns. */
static void fill_random(hd_frame *frame, uint64_t seed)
{
    const hd_columns own = hd_frame_columns(frame);
    hd_random random = hd_random_seeded(seed, 1);
    for (int row = 0; row < frame->rows; row++)
        for (int col = 0; col < frame->vectors; col++) {
            const double entry = hd_random_symmetric(&random);
            if (col >= own.first && col < own.first + own.count)
                frame->copy[0][(size_t)row * (size_t)own.stride + (size_t)(col - own.first)] =
                    entry;
        }
}

hd_status hd_frame_create(hd_frame **out, const hd_scene_def *scene, int vectors, uint64_t seed,
                          int threads)
{
    return hd_frame_create_shared(out, scene, vectors, seed, threads, NULL);
}

hd_status hd_frame_create_shared(hd_frame **out, const hd_scene_def *scene, int vectors,
                                 uint64_t seed, int threads, hd_communicator *communicator)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    const int particles = scene->number, rows = 2 * of->coordinates;
    HD_ASSERT(particles >= 1 && vectors >= 1 && vectors <= rows * particles && threads >= 1);
    hd_frame *frame = hd_memory_alloc(1, sizeof *frame);
    *out = NULL;
    const hd_status head = hd_communicator_agree(communicator, frame ? HD_OK : HD_NO_MEMORY);
    if (head != HD_OK) {
        hd_memory_free(frame);
        return head;
    }
    frame->scene = *scene;
    frame->of = of;
    frame->particles = particles;
    frame->rows = rows * particles;
    frame->vectors = vectors;
    frame->communicator = communicator;
    frame->stride = padded(part_of(frame, vectors));
    frame->rows_kept = rows * part_of(frame, particles) * hd_communicator_ranks(communicator);
    frame->width = block_width(of, frame->rows, frame->stride);
    frame->threads = frame->threads_max = threads;
    const hd_status status = hd_communicator_agree(communicator, frame_allocate(frame));
    if (status != HD_OK) {
        hd_frame_free(frame);
        return status;
    }
    fill_random(frame, seed);
    *out = frame;
    return HD_OK;
}

void hd_frame_free(hd_frame *frame)
{
    if (!frame) return;
    hd_memory_free(frame->copy[0]);
    hd_memory_free(frame->copy[1]);
    hd_memory_free(frame->buffer);
    if (frame->maps) hd_maps_free_of(frame->of, frame->maps);
    hd_memory_free(frame);
}

int hd_frame_rows(const hd_frame *frame) { return frame->rows; }
int hd_frame_coordinates(const hd_frame *frame) { return frame->of->coordinates; }
int hd_frame_vectors(const hd_frame *frame) { return frame->vectors; }
int hd_frame_stride(const hd_frame *frame) { return frame->stride; }

void hd_frame_use_threads(hd_frame *frame, int threads)
{
    HD_ASSERT(threads >= 1 && threads <= frame->threads_max);
    frame->threads = threads;
}

double *hd_frame_data(hd_frame *frame) { return frame->copy[frame->current]; }
const double *hd_frame_read(const hd_frame *frame) { return frame->copy[frame->current]; }

hd_columns hd_frame_columns(const hd_frame *frame)
{
    const int first = hd_communicator_rank(frame->communicator) * frame->stride;
    const int left = frame->vectors > first ? frame->vectors - first : 0;
    return (hd_columns){hd_frame_read(frame), frame->stride, left > 0 ? first : frame->vectors,
                        left < frame->stride ? left : frame->stride};
}

/* ---- all vectors of some particles --------------------------------------------------------- */

/** Number of entries that go to each rank: some rows of this rank's columns. */
static size_t part_size(const hd_frame *frame)
{
    return (size_t)hd_frame_rows_here(frame) * (size_t)frame->stride;
}

void hd_frame_to_rows(hd_frame *frame)
{
    HD_ASSERT(!frame->by_rows);
    hd_communicator_exchange(frame->communicator, hd_frame_data(frame), part_size(frame));
    frame->by_rows = true;
}

void hd_frame_to_columns(hd_frame *frame)
{
    HD_ASSERT(frame->by_rows);
    hd_communicator_exchange(frame->communicator, hd_frame_data(frame), part_size(frame));
    frame->by_rows = false;
}

int hd_frame_rows_here(const hd_frame *frame)
{
    return frame->rows_kept / hd_communicator_ranks(frame->communicator);
}

double *hd_frame_vector(hd_frame *frame, int col)
{
    return hd_frame_data(frame) + part_size(frame) * (size_t)(col / frame->stride) +
           col % frame->stride;
}

int hd_frame_neighbours(const hd_frame *frame, int col)
{
    const int end = (col / frame->stride + 1) * frame->stride;
    return (end < frame->vectors ? end : frame->vectors) - col;
}

void hd_frame_gather(const hd_frame *frame, int first, int count, double *x)
{
    const hd_columns own = hd_frame_columns(frame);
    const size_t rows = (size_t)frame->rows, wide = (size_t)count;
    memset(x, 0, rows * wide * sizeof *x);
    for (size_t row = 0; row < rows; row++)
        for (int col = own.first > first ? own.first : first;
             col < own.first + own.count && col < first + count; col++)
            x[row * wide + (size_t)(col - first)] =
                own.data[row * (size_t)own.stride + (size_t)(col - own.first)];
    hd_communicator_sum(frame->communicator, x, rows * wide);
}

const double *hd_frame_before(const hd_frame *frame) { return frame->copy[1 - frame->current]; }
void hd_frame_rewind(hd_frame *frame)
{
    frame->current = 1 - frame->current;
    frame->by_rows = false;
}

/* ---- what can be read ---------------------------------------------------------------------- */

/** Sums over all particles of dq.dq, dp.dp and dq.dp for columns [col, col + count), count <= 64.
 */
static void halves_of_columns(const hd_frame *frame, double sum[3][HD_BLOCK_WIDTH_MAX], int col,
                              int count)
{
    memset(sum, 0, 3 * sizeof *sum);
    const int half = frame->of->coordinates;
    for (int row = 0; row < frame->rows; row += 2 * half)
        for (int d = 0; d < half; d++) {
            const double *v = frame->copy[frame->current] + col;
            const double *dq = v + (size_t)(row + d) * (size_t)frame->stride;
            const double *dp = dq + (size_t)half * (size_t)frame->stride;
            for (int k = 0; k < count; k++) {
                sum[0][k] += dq[k] * dq[k];
                sum[1][k] += dp[k] * dp[k];
                sum[2][k] += dq[k] * dp[k];
            }
        }
}

void hd_frame_dq_dp(const hd_frame *frame, double *cos_theta, double *dp_dq_ratio)
{
    const int n = hd_frame_columns(frame).count;
#pragma omp parallel for schedule(static) num_threads(frame->threads) if (frame->threads > 1)
    for (int col = 0; col < n; col += HD_BLOCK_WIDTH_MAX) {
        double sum[3][HD_BLOCK_WIDTH_MAX];
        const int count = n - col < HD_BLOCK_WIDTH_MAX ? n - col : HD_BLOCK_WIDTH_MAX;
        halves_of_columns(frame, sum, col, count);
        for (int k = 0; k < count; k++) {
            const bool dq = sum[0][k] > SQUARE_MIN, dp = sum[1][k] > SQUARE_MIN;
            cos_theta[col + k] = dq && dp ? sum[2][k] / (sqrt(sum[0][k]) * sqrt(sum[1][k])) : NAN;
            dp_dq_ratio[col + k] = dq ? sqrt(sum[1][k] / sum[0][k]) : NAN;
        }
    }
}

/** Copies this rank's columns into some rows of the whole frame, or out of them. */
static void copy_rows(hd_frame *frame, double *rows, int first, int count, bool out)
{
    const hd_columns own = hd_frame_columns(frame);
    for (int row = 0; row < count && own.count > 0; row++) {
        double *here = hd_frame_data(frame) + (size_t)(first + row) * (size_t)frame->stride;
        double *there = rows + (size_t)row * (size_t)frame->vectors + own.first;
        memcpy(out ? here : there, out ? there : here, (size_t)own.count * sizeof *here);
    }
}

/** Reads or writes some rows of the whole frame at a time. */
static hd_status archive_shared(hd_frame *frame, hd_archive *archive)
{
    enum { ROWS = 32 };
    const size_t n = (size_t)frame->vectors;
    double *rows = hd_memory_alloc(ROWS * n, sizeof *rows);
    hd_status status = hd_communicator_agree(frame->communicator, rows ? HD_OK : HD_NO_MEMORY);
    for (int first = 0; first < frame->rows && status == HD_OK; first += ROWS) {
        const int count = frame->rows - first < ROWS ? frame->rows - first : ROWS;
        copy_rows(frame, rows, first, count, false);
        if (archive->writing)
            status = hd_communicator_share(
                frame->communicator, rows,
                (hd_shared){(size_t)count, n, (size_t)frame->stride, n, 0});
        for (int row = 0; row < count && status == HD_OK; row++)
            hd_archive_next_doubles(archive, rows + (size_t)row * n, n);
        copy_rows(frame, rows, first, count, true);
    }
    hd_memory_free(rows);
    return status;
}

double hd_frame_archived(const hd_dynamics *of, int particles, int vectors)
{
    return 2.0 * of->coordinates * particles * vectors;
}

hd_status hd_frame_archive(hd_frame *frame, hd_archive *archive)
{
    const size_t rows = (size_t)frame->rows, n = (size_t)frame->vectors;
    hd_archive_of_doubles(archive, "frame vectors", rows * n);
    if (frame->communicator) return archive_shared(frame, archive);
    for (size_t row = 0; row < rows; row++)
        hd_archive_next_doubles(archive, hd_frame_data(frame) + row * (size_t)frame->stride, n);
    return HD_OK;
}
