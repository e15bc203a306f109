/** Positions -> list of pairs that are near. Cells are no narrower than the reach of the list. If
 * fewer than three fit along an edge, each is visited once. */
#include "dynamics/soft/neighbours.h"

#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"

static const double SKIN = 0.35;
/** The most cells per particle, and the first room for partners per particle. */
enum { CELLS_EACH = 4, PARTNERS_EACH = 8 };

static size_t cells_of(const hd_neighbours *n)
{
    return (size_t)n->size[0] * (size_t)n->size[1] * (size_t)n->size[2];
}

/** Chooses the number of cells. In an almost empty box they are wider, so as not to be too many. */
static void choose_cells(hd_neighbours *n)
{
    const double most = 1.0 + CELLS_EACH * (double)n->count;
    double wide[HD_DIMENSION_MAX] = {1.0, 1.0, 1.0};
    for (int d = 0; d < n->dimension; d++) wide[d] = fmax(1.0, floor(n->box[d] / n->reach));
    while (wide[0] * wide[1] * wide[2] > most)
        for (int d = 0; d < n->dimension; d++)
            if (wide[d] >= 2.0) wide[d] = floor(0.5 * wide[d]);
    for (int d = 0; d < HD_DIMENSION_MAX; d++) n->size[d] = (int32_t)wide[d];
}

hd_status hd_neighbours_create(hd_neighbours *n, const hd_scene_def *scene, double cut)
{
    const size_t count = (size_t)scene->number, dimension = (size_t)hd_scene_dimension(scene);
    *n = (hd_neighbours){.count = scene->number, .dimension = hd_scene_dimension(scene)};
    hd_scene_box(scene, n->box);
    n->reach = cut + SKIN;
    n->capacity = PARTNERS_EACH * count;
    choose_cells(n);
    n->head = hd_memory_alloc(cells_of(n), sizeof *n->head);
    n->next = hd_memory_alloc(count, sizeof *n->next);
    n->place = hd_memory_alloc(count * dimension, sizeof *n->place);
    n->first = hd_memory_alloc(count + 1, sizeof *n->first);
    n->partner = hd_memory_alloc(n->capacity, sizeof *n->partner);
    hd_neighbours_forget(n);
    return n->head && n->next && n->place && n->first && n->partner ? HD_OK : HD_NO_MEMORY;
}

double hd_neighbours_expected(const hd_scene_def *scene, double reach)
{
    static const double PI = 3.14159265358979323846;
    const double half = hd_scene_dimension(scene) == 2 ? 0.5 : 2.0 / 3.0 * reach;
    return half * PI * reach * reach * scene->density;
}

double hd_neighbours_bytes(const hd_scene_def *scene, double cut)
{
    const double number = sizeof(int32_t), place = 8.0 * hd_scene_dimension(scene);
    const double cell = pow(cut + SKIN, hd_scene_dimension(scene)),
                 cells = fmin(CELLS_EACH, 1.0 / (scene->density * cell));
    double partners = PARTNERS_EACH;
    while (partners < hd_neighbours_expected(scene, cut + SKIN)) partners *= 2.0;
    const double before = partners > PARTNERS_EACH ? 0.5 * partners : 0.0;
    return scene->number * (place + (double)sizeof(size_t) + number * (1.0 + cells + partners) +
                            fmax(number * before, 2.0 * place));
}

void hd_neighbours_clear(hd_neighbours *n)
{
    hd_memory_free(n->head);
    hd_memory_free(n->next);
    hd_memory_free(n->place);
    hd_memory_free(n->first);
    hd_memory_free(n->partner);
    *n = (hd_neighbours){0};
}

void hd_neighbours_forget(hd_neighbours *n) { n->moved = -1.0; }

/* ---- the list ------------------------------------------------------------------------------ */

static double square_between(const hd_neighbours *n, const double *a, const double *b)
{
    double square = 0.0;
    for (int d = 0; d < n->dimension; d++) {
        const double r = hd_nearest(b[d] - a[d], n->box[d]);
        square += r * r;
    }
    return square;
}

static void cell_of(int32_t cell[HD_DIMENSION_MAX], const hd_neighbours *n, int32_t i)
{
    for (int d = 0; d < HD_DIMENSION_MAX; d++) cell[d] = 0;
    for (int d = 0; d < n->dimension; d++) {
        const int32_t k = (int32_t)(n->place[n->dimension * i + d] / n->box[d] * n->size[d]);
        cell[d] = k < n->size[d] ? k : n->size[d] - 1;
    }
}

static int32_t *head_of(const hd_neighbours *n, const int32_t cell[HD_DIMENSION_MAX])
{
    return &n->head[((int64_t)cell[2] * n->size[1] + cell[1]) * n->size[0] + cell[0]];
}

static hd_status reserve(hd_neighbours *n, size_t count)
{
    if (count <= n->capacity) return HD_OK;
    int32_t *grown = hd_memory_alloc(2 * count, sizeof *grown);
    if (!grown) return HD_NO_MEMORY;
    memcpy(grown, n->partner, n->capacity * sizeof *grown);
    hd_memory_free(n->partner);
    n->partner = grown;
    n->capacity = 2 * count;
    return HD_OK;
}

/** Adds the partners of i that are in the list of a cell, from j on, so that partners from `begin`
 * on stay in ascending order. */
static hd_status take_cell(hd_neighbours *n, size_t begin, size_t *end, int32_t i, int32_t j)
{
    const double *q = n->place, square = n->reach * n->reach;
    const int of_one = n->dimension;
    for (; j >= 0; j = n->next[j]) {
        if (j <= i || !(square_between(n, q + of_one * i, q + of_one * j) < square)) continue;
        HD_TRY(reserve(n, *end + 1));
        size_t k = (*end)++;
        for (; k > begin && n->partner[k - 1] > j; k--) n->partner[k] = n->partner[k - 1];
        n->partner[k] = j;
    }
    return HD_OK;
}

static hd_status take_around(hd_neighbours *n, size_t begin, size_t *end, int32_t i)
{
    int32_t at[HD_DIMENSION_MAX], around[HD_DIMENSION_MAX], k[HD_DIMENSION_MAX];
    cell_of(at, n, i);
    for (int d = 0; d < HD_DIMENSION_MAX; d++) around[d] = n->size[d] < 3 ? n->size[d] : 3;
    for (k[2] = 0; k[2] < around[2]; k[2]++)
        for (k[1] = 0; k[1] < around[1]; k[1]++)
            for (k[0] = 0; k[0] < around[0]; k[0]++) {
                int32_t cell[HD_DIMENSION_MAX];
                for (int d = 0; d < HD_DIMENSION_MAX; d++)
                    cell[d] = (at[d] + n->size[d] - 1 + k[d]) % n->size[d];
                HD_TRY(take_cell(n, begin, end, i, *head_of(n, cell)));
            }
    return HD_OK;
}

static hd_status make_list(hd_neighbours *n, const double *q)
{
    const size_t all = (size_t)(n->count * n->dimension);
    for (size_t k = 0; k < all; k++)
        if (!(q[k] >= 0 && q[k] <= n->box[(int)k % n->dimension])) return HD_NOT_FINITE;
    memcpy(n->place, q, all * sizeof *q);
    for (size_t k = 0; k < cells_of(n); k++) n->head[k] = -1;
    for (int32_t i = 0; i < n->count; i++) {
        int32_t cell[HD_DIMENSION_MAX];
        cell_of(cell, n, i);
        n->next[i] = *head_of(n, cell);
        *head_of(n, cell) = i;
    }
    for (int32_t i = 0; i < n->count; i++) {
        size_t end = n->first[i];
        HD_TRY(take_around(n, n->first[i], &end, i));
        n->first[i + 1] = end;
    }
    n->moved = 0.25 * SKIN * SKIN;
    return HD_OK;
}

hd_status hd_neighbours_follow(hd_neighbours *n, const double *q)
{
    bool holds = n->moved > 0;
    for (int i = 0; i < n->count && holds; i++)
        holds = square_between(n, n->place + n->dimension * i, q + n->dimension * i) < n->moved;
    return holds ? HD_OK : make_list(n, q);
}
