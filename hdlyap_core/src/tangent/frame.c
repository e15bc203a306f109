/** Event log -> tangent vectors.
 *
 * V is 4N x n, row-major, rows 4i .. 4i+3 = dq_x dq_y dp_x dp_y of disk i. The log is first turned
 * into tangent maps with all divisions done. Then each thread takes a block of columns into a
 * buffer that stays in its cache, [disk][4][width], carries it through all maps with lazy free
 * flight (only disks that collide are brought up to date), and writes it to the second copy of V;
 * so the vectors from before remain for hd_frame_rewind at no cost in time. Equations [T1], [T3],
 * [T4]. Parallel over blocks; the result does not depend on the number of threads. */
#include "hdlyap/frame.h"

#include <float.h>
#include <math.h>
#include <omp.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/multiversion.h"
#include "base/random.h"
#include "tangent/archived.h"

/** Sums of squares below are no longer known to rounding: such a half counts as none. */
static const double SQUARE_MIN = DBL_MIN / DBL_EPSILON;
enum { BLOCK_BYTES = 512 * 1024, BLOCK_WIDTH_MAX = 64 };
/** Events that are fetched ahead, where the disks of a block outgrow the cache. */
enum { FETCH_AHEAD = 12, LINE = 64 / sizeof(double) };

/** Tangent map of one event: free flights of its disks since their last events, then the collision.
 */
typedef struct tangent_map {
    int32_t i, j;     /**< as in hd_event */
    double flight[2]; /**< of i, of j */
    double n[2];
    double normal;     /**< b = p.n < 0 */
    double tangential; /**< p_t = p.t, t = n turned by +90 degrees */
    double ratio;      /**< p_t / b */
} tangent_map;

struct hd_frame {
    int disks, rows, vectors, stride;
    int threads, threads_max;
    int width;       /**< of a block: 1, 2, 4, 8, 16, 32 or 64 columns */
    double *copy[2]; /**< [rows * stride] */
    int current;
    double *buffer;   /**< [threads][rows * width] */
    tangent_map *map; /**< [map_capacity], of the interval being replayed */
    size_t map_capacity;
    bool walls;    /**< some of them are of wall events */
    double *since; /**< [disks], time of each disk's last event, then its last flight */
};

/* ---- creation ------------------------------------------------------------------------------ */

/** Rows of whole cache lines; with room for the neutral vectors that complete the positive half
 * (slow_vectors.h). */
static int padded(int vectors)
{
    enum { NEUTRAL_MAX = 3, MANY = 64 };
    int width = 1;
    if (vectors >= MANY) vectors += NEUTRAL_MAX;
    while (width < vectors && width < 8) width *= 2;
    return (vectors + width - 1) / width * width;
}

static int block_width(int rows, int stride)
{
    int width = stride < 8 ? stride : 8;
    while (width < BLOCK_WIDTH_MAX && 2 * width <= stride &&
           (size_t)rows * (size_t)width * 2 * sizeof(double) <= BLOCK_BYTES)
        width *= 2;
    return width;
}

static hd_status frame_allocate(hd_frame *frame)
{
    const size_t size = (size_t)frame->rows * (size_t)frame->stride;
    for (int k = 0; k < 2; k++)
        if (!(frame->copy[k] = hd_memory_alloc(size, sizeof(double)))) return HD_NO_MEMORY;
    const size_t block = (size_t)frame->rows * (size_t)frame->width;
    frame->buffer = hd_memory_alloc(block * (size_t)frame->threads, sizeof(double));
    frame->since = hd_memory_alloc((size_t)frame->disks, sizeof(double));
    return frame->buffer && frame->since ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_frame_create(hd_frame **out, int disks, int vectors, uint64_t seed, int threads)
{
    HD_ASSERT(disks >= 1 && vectors >= 1 && vectors <= 4 * disks && threads >= 1);
    hd_frame *frame = hd_memory_alloc(1, sizeof *frame);
    *out = NULL;
    if (!frame) return HD_NO_MEMORY;
    frame->disks = disks;
    frame->rows = 4 * disks;
    frame->vectors = vectors;
    frame->stride = padded(vectors);
    frame->width = block_width(frame->rows, frame->stride);
    frame->threads = frame->threads_max = threads;
    const hd_status status = frame_allocate(frame);
    if (status != HD_OK) {
        hd_frame_free(frame);
        return status;
    }
    hd_random random = hd_random_seeded(seed, 1);
    for (int row = 0; row < frame->rows; row++)
        for (int col = 0; col < vectors; col++)
            frame->copy[0][(size_t)row * (size_t)frame->stride + (size_t)col] = hd_random_symmetric(
                &random);
    *out = frame;
    return HD_OK;
}

void hd_frame_free(hd_frame *frame)
{
    if (!frame) return;
    hd_memory_free(frame->copy[0]);
    hd_memory_free(frame->copy[1]);
    hd_memory_free(frame->buffer);
    hd_memory_free(frame->map);
    hd_memory_free(frame->since);
    hd_memory_free(frame);
}

int hd_frame_rows(const hd_frame *frame) { return frame->rows; }
int hd_frame_vectors(const hd_frame *frame) { return frame->vectors; }
int hd_frame_stride(const hd_frame *frame) { return frame->stride; }
int hd_frame_threads(const hd_frame *frame) { return frame->threads; }

void hd_frame_use_threads(hd_frame *frame, int threads)
{
    HD_ASSERT(threads >= 1 && threads <= frame->threads_max);
    frame->threads = threads;
}

double *hd_frame_data(hd_frame *frame) { return frame->copy[frame->current]; }
const double *hd_frame_read(const hd_frame *frame) { return frame->copy[frame->current]; }

hd_columns hd_frame_columns(const hd_frame *frame)
{
    return (hd_columns){hd_frame_read(frame), frame->stride, 0, frame->vectors};
}

/* ---- the log as tangent maps --------------------------------------------------------------- */

static double flight(double *since, int32_t disk, double t)
{
    const double tau = t - since[disk];
    since[disk] = t;
    return tau;
}

static void map_fill(tangent_map *map, const hd_event *event, double *since)
{
    *map = (tangent_map){.i = event->i, .j = event->j, .n = {event->n[0], event->n[1]}};
    map->flight[0] = flight(since, event->i, event->t);
    if (event->j < 0) return;
    map->flight[1] = flight(since, event->j, event->t);
    map->normal = event->p[0] * event->n[0] + event->p[1] * event->n[1];
    map->tangential = event->p[1] * event->n[0] - event->p[0] * event->n[1];
    map->ratio = map->tangential / map->normal;
}

static hd_status maps_reserve(hd_frame *frame, size_t count)
{
    if (count <= frame->map_capacity) return HD_OK;
    hd_memory_free(frame->map);
    frame->map_capacity = count + count / 2;
    frame->map = hd_memory_alloc(frame->map_capacity, sizeof *frame->map);
    if (frame->map) return HD_OK;
    frame->map_capacity = 0;
    return HD_NO_MEMORY;
}

/** Fills frame->map and leaves each disk's last flight in frame->since; returns the number of maps.
 */
static size_t maps_fill(hd_frame *frame, const hd_event_log *log, double t_begin, double t_end)
{
    const bool last = t_end >= log->duration;
    size_t count = 0;
    frame->walls = false;
    for (int i = 0; i < frame->disks; i++) frame->since[i] = t_begin;
    for (size_t e = 0; e < log->count; e++) {
        if (log->event[e].t < t_begin) continue;
        if (log->event[e].t >= t_end && !last) break;
        frame->walls |= log->event[e].j < 0;
        map_fill(&frame->map[count++], &log->event[e], frame->since);
    }
    for (int i = 0; i < frame->disks; i++) frame->since[i] = t_end - frame->since[i];
    return count;
}

/* ---- a block of columns -------------------------------------------------------------------- */

/** [T1] dq += tau dp; v points to the four rows of a disk. */
static inline __attribute__((always_inline)) void fly(double *restrict v, double tau, int width)
{
    for (int k = 0; k < 2 * width; k++) v[k] += tau * v[2 * width + k];
}

/** [T3] with the free flights before it; only the tangential part s of the displacement turns n. */
static inline __attribute__((always_inline)) void collide(double *restrict vi, double *restrict vj,
                                                          const tangent_map *map, int width)
{
    const double nx = map->n[0], ny = map->n[1], ti = map->flight[0], tj = map->flight[1];
    const double b = map->normal, pt = map->tangential, ratio = map->ratio;
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *qi = vi + k, *pi = vi + 2 * width + k, *qj = vj + k, *pj = vj + 2 * width + k;
        const double qix = qi[0] + ti * pi[0], qiy = qi[width] + ti * pi[width];
        const double qjx = qj[0] + tj * pj[0], qjy = qj[width] + tj * pj[width];
        const double qx = qjx - qix, qy = qjy - qiy;
        const double px = pj[0] - pi[0], py = pj[width] - pi[width];
        const double a = qx * nx + qy * ny;                     /* dq.n */
        const double s = qy * nx - qx * ny - ratio * a;         /* dq.t - (p_t / b) a */
        const double u = px * nx + py * ny + pt * s, w = b * s; /* d + p_t s, b s */
        const double ux = u * nx - w * ny, uy = u * ny + w * nx;
        qi[0] = qix + a * nx, qi[width] = qiy + a * ny;
        qj[0] = qjx - a * nx, qj[width] = qjy - a * ny;
        pi[0] += ux, pi[width] += uy;
        pj[0] -= ux, pj[width] -= uy;
    }
}

/** [T4] */
static inline __attribute__((always_inline)) void reflect(double *restrict v,
                                                          const tangent_map *map, int width)
{
    const int d = map->j == HD_WALL_Y;
    fly(v, map->flight[0], width);
    for (int k = 0; k < width; k++) {
        v[d * width + k] = -v[d * width + k];
        v[(2 + d) * width + k] = -v[(2 + d) * width + k];
    }
}

typedef struct maps {
    const tangent_map *map; /**< [count] */
    size_t count;
    size_t fetching; /**< at the first ones of them, those FETCH_AHEAD later are fetched */
} maps;

/** The rows of both disks, into the cache. A wall fetches those of i alone. */
static inline __attribute__((always_inline)) void fetch(const double *buffer,
                                                        const tangent_map *map, int width)
{
    const size_t disk = 4 * (size_t)width;
    const double *vi = buffer + disk * (size_t)map->i;
    const double *vj = map->j >= 0 ? buffer + disk * (size_t)map->j : vi;
    for (size_t k = 0; k < disk; k += LINE) {
        __builtin_prefetch(vi + k, 1);
        __builtin_prefetch(vj + k, 1);
    }
}

static inline __attribute__((always_inline)) void replay_width(double *buffer, maps m, bool walls,
                                                               int width)
{
    const size_t disk = 4 * (size_t)width;
    const tangent_map *map = m.map;
    for (size_t e = 0; e < m.count; e++) {
        if (e < m.fetching) fetch(buffer, &map[e + FETCH_AHEAD], width);
        double *vi = buffer + disk * (size_t)map[e].i;
        if (!walls || map[e].j >= 0)
            collide(vi, buffer + disk * (size_t)map[e].j, &map[e], width);
        else
            reflect(vi, &map[e], width);
    }
}

/** The widths are spelled out so that the compiler unrolls and vectorises each. */
static inline __attribute__((always_inline)) void replay_any(double *buffer, maps m, bool walls,
                                                             int width)
{
    switch (width) {
    case 1: replay_width(buffer, m, walls, 1); break;
    case 2: replay_width(buffer, m, walls, 2); break;
    case 4: replay_width(buffer, m, walls, 4); break;
    case 8: replay_width(buffer, m, walls, 8); break;
    case 16: replay_width(buffer, m, walls, 16); break;
    case 32: replay_width(buffer, m, walls, 32); break;
    default: replay_width(buffer, m, walls, BLOCK_WIDTH_MAX); break;
    }
}

HD_MULTIVERSION
static void replay_block(double *buffer, maps m, int width) { replay_any(buffer, m, false, width); }

/** The same for a log that holds wall events. */
HD_MULTIVERSION
static void replay_block_with_walls(double *buffer, maps m, int width)
{
    replay_any(buffer, m, true, width);
}

/** Columns [col, col + used) of V into the buffer, or back. */
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

static maps maps_of(const hd_frame *frame, size_t count)
{
    const size_t bytes = (size_t)frame->rows * (size_t)frame->width * sizeof(double);
    const bool is_far = bytes > BLOCK_BYTES && count > FETCH_AHEAD;
    return (maps){frame->map, count, is_far ? count - FETCH_AHEAD : 0};
}

static void block_replay(const hd_frame *frame, double *buffer, size_t count, int block)
{
    const maps m = maps_of(frame, count);
    const int width = frame->width, col = block * width;
    const int used = col + width <= frame->stride ? width : frame->stride - col;
    block_load(frame, buffer, col, used);
    if (frame->walls)
        replay_block_with_walls(buffer, m, width);
    else
        replay_block(buffer, m, width);
    for (int i = 0; i < frame->disks; i++)
        fly(buffer + 4 * (size_t)width * (size_t)i, frame->since[i], width);
    block_store(frame, buffer, col, used);
}

hd_status hd_frame_replay(hd_frame *frame, const hd_event_log *log, double t_begin, double t_end)
{
    HD_TRY(maps_reserve(frame, log->count));
    const size_t count = maps_fill(frame, log, t_begin, t_end);
    const int blocks = (frame->stride + frame->width - 1) / frame->width;
    const size_t block_size = (size_t)frame->rows * (size_t)frame->width;
#pragma omp parallel for schedule(dynamic) num_threads(frame->threads) if (frame->threads > 1)
    for (int block = 0; block < blocks; block++)
        block_replay(frame, frame->buffer + block_size * (size_t)omp_get_thread_num(), count,
                     block);
    frame->current = 1 - frame->current;
    return HD_OK;
}

const double *hd_frame_before(const hd_frame *frame) { return frame->copy[1 - frame->current]; }
void hd_frame_rewind(hd_frame *frame) { frame->current = 1 - frame->current; }

/* ---- what can be read ---------------------------------------------------------------------- */

/** Sums over all disks of dq.dq, dp.dp and dq.dp for columns [col, col + count), count <= 64. */
static void halves_of_columns(const hd_frame *frame, double sum[3][BLOCK_WIDTH_MAX], int col,
                              int count)
{
    memset(sum, 0, 3 * sizeof *sum);
    for (int row = 0; row < frame->rows; row += 4)
        for (int d = 0; d < 2; d++) {
            const double *v = frame->copy[frame->current] + col;
            const double *dq = v + (size_t)(row + d) * (size_t)frame->stride;
            const double *dp = dq + 2 * (size_t)frame->stride;
            for (int k = 0; k < count; k++) {
                sum[0][k] += dq[k] * dq[k];
                sum[1][k] += dp[k] * dp[k];
                sum[2][k] += dq[k] * dp[k];
            }
        }
}

void hd_frame_halves(const hd_frame *frame, double *cos_theta, double *dp_dq_ratio)
{
    const int n = frame->vectors;
#pragma omp parallel for schedule(static) num_threads(frame->threads) if (frame->threads > 1)
    for (int col = 0; col < n; col += BLOCK_WIDTH_MAX) {
        double sum[3][BLOCK_WIDTH_MAX];
        const int count = n - col < BLOCK_WIDTH_MAX ? n - col : BLOCK_WIDTH_MAX;
        halves_of_columns(frame, sum, col, count);
        for (int k = 0; k < count; k++) {
            const bool dq = sum[0][k] > SQUARE_MIN, dp = sum[1][k] > SQUARE_MIN;
            cos_theta[col + k] = dq && dp ? sum[2][k] / (sqrt(sum[0][k]) * sqrt(sum[1][k])) : NAN;
            dp_dq_ratio[col + k] = dq ? sqrt(sum[1][k] / sum[0][k]) : NAN;
        }
    }
}

void hd_frame_archive(hd_frame *frame, hd_archive *archive)
{
    const size_t rows = (size_t)frame->rows, n = (size_t)frame->vectors;
    hd_archive_of_doubles(archive, "frame vectors", rows * n);
    for (size_t row = 0; row < rows; row++)
        hd_archive_next_doubles(archive, hd_frame_data(frame) + row * (size_t)frame->stride, n);
}
