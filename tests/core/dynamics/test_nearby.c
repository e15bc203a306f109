/** Nearby: everybody in the cells around a disk, once for each way to see it, and the contacts the
 * same bits as one by one. */
#include "dynamics/hard/nearby.h"
#include "one_contact.h"
#include "base/random.h"
#include "testing.h"

enum { DISKS = 60, SEEN_MAX = 9 * DISKS };

static double uniform(hd_random *random) { return 0.5 + 0.5 * hd_random_symmetric(random); }

static int below(hd_random *random, int n) { return (int)(uniform(random) * n); }

/* ---- who ----------------------------------------------------------------------------------- */

/** A disk as seen from another: its number and image. */
typedef struct seen {
    int32_t disk, image[2];
} seen;

typedef struct sight {
    int count;
    seen seen[SEEN_MAX];
} sight;

static int seen_order(const void *a, const void *b) { return memcmp(a, b, sizeof(seen)); }

static void sight_take(sight *s, const hd_nearby *near)
{
    assert_true(near->count >= 0 && near->count <= HD_NEARBY_MAX);
    for (int k = 0; k < near->count; k++)
        s->seen[s->count++] = (seen){near->disk[k], {near->image[0][k], near->image[1][k]}};
}

static void sight_take_listed(sight *s, const hd_cells *cells, const hd_disk *disk, int u, int v)
{
    const int32_t at[2] = {cells->line[0][disk->cell[0]].near[u],
                           cells->line[1][disk->cell[1]].near[v]};
    const hd_cell *cell = hd_cells_at(cells, at);
    hd_nearby near;
    for (int32_t j = cell->crowded ? cell->disk[HD_CELL_DISKS - 1] : -1; j >= 0;) {
        j = hd_nearby_listed(&near, cells, disk, 3 * v + u, j);
        sight_take(s, &near);
    }
}

/** What the rectangle of sides shows, by the disks' own columns and rows. */
static void sight_expected(sight *s, const hd_cells *cells, const hd_disk *disks,
                           const hd_disk *disk, const int x[2], const int y[2])
{
    for (int u = x[0]; u <= x[1]; u++)
        for (int v = y[0]; v <= y[1]; v++) {
            const hd_cell_line *lx = &cells->line[0][disk->cell[0]];
            const hd_cell_line *ly = &cells->line[1][disk->cell[1]];
            for (int32_t j = 0; j < DISKS; j++)
                if (disks[j].cell[0] == lx->near[u] && disks[j].cell[1] == ly->near[v])
                    s->seen[s->count++] = (seen){
                        j, {lx->shift[u] + disk->wrap[0], ly->shift[v] + disk->wrap[1]}};
        }
}

static void check_sight(sight *got, sight *want)
{
    assert_int_equal(got->count, want->count);
    qsort(got->seen, (size_t)got->count, sizeof(seen), seen_order);
    qsort(want->seen, (size_t)want->count, sizeof(seen), seen_order);
    assert_memory_equal(got->seen, want->seen, (size_t)got->count * sizeof(seen));
}

static void check_around(const hd_cells *cells, const hd_disk *disks, const hd_disk *disk)
{
    static sight got, want;
    const int all[2] = {0, 2};
    hd_nearby near;
    got.count = want.count = 0;
    hd_nearby_around(&near, cells, disk);
    sight_take(&got, &near);
    for (int k = 0; k < 9; k++) sight_take_listed(&got, cells, disk, k % 3, k / 3);
    assert_int_equal(near.crowded, got.count > near.count);
    sight_expected(&want, cells, disks, disk, all, all);
    check_sight(&got, &want);
}

static void check_beside(const hd_cells *cells, const hd_disk *disks, const hd_disk *disk, int d,
                         int side)
{
    static sight got, want;
    const int across[2] = {side, side}, along[2] = {0, 2};
    hd_nearby near;
    got.count = want.count = 0;
    hd_nearby_beside(&near, cells, disk, d, side);
    sight_take(&got, &near);
    for (int k = 0; k < 3; k++)
        sight_take_listed(&got, cells, disk, d == 0 ? side : k, d == 0 ? k : side);
    assert_int_equal(near.crowded, got.count > near.count);
    sight_expected(&want, cells, disks, disk, d == 0 ? across : along, d == 0 ? along : across);
    check_sight(&got, &want);
}

/** Few and many columns, both boundaries; points, so that any number of them is in a cell; `crowd`
 * of them in one place. */
static void check_box(double lx, double ly, hd_boundary boundary, int crowd)
{
    static hd_disk disks[DISKS];
    const hd_scene_def def = scene_in_box(DISKS, lx, ly, boundary, boundary, 1);
    hd_random random = hd_random_seeded(3, (uint64_t)crowd);
    hd_cells cells;
    CHECK_OK(hd_cells_create(&cells, &def, 1.0));
    for (int32_t i = 0; i < DISKS; i++) {
        disks[i] = (hd_disk){.q = {lx * uniform(&random), ly * uniform(&random)}};
        if (i < crowd) disks[i].q[0] = disks[i].q[1] = 1.0;
        hd_cells_add(&cells, disks, i);
        for (int d = 0; d < 2; d++) disks[i].wrap[d] = below(&random, 5) - 2;
    }
    for (int32_t i = 0; i < DISKS; i++) {
        check_around(&cells, disks, &disks[i]);
        for (int k = 0; k < 4; k++) check_beside(&cells, disks, &disks[i], k % 2, k < 2 ? 0 : 2);
    }
    hd_cells_clear(&cells);
}

TEST(everybody_around_is_seen_once)
{
    const double edge[] = {1.7, 2.3, 3.4, 8.0, 30.0};
    const int crowd[] = {0, 4, HD_NEARBY_MAX + HD_CELL_DISKS - 1, HD_NEARBY_MAX + HD_CELL_DISKS,
                         50};
    for (int k = 0; k < 25; k++)
        for (int c = 0; c < 5; c++) {
            check_box(edge[k % 5], edge[k / 5], P, crowd[c]);
            check_box(edge[k % 5], edge[k / 5], R, crowd[c]);
        }
}

/** An image is where it is said to be: within the reach of the cells around, whatever the wraps. */
TEST(images_are_in_reach)
{
    static hd_disk disks[DISKS];
    const hd_scene_def def = scene_in_box(DISKS, 12.0, 9.0, P, P, 1);
    hd_random random = hd_random_seeded(4, 0);
    hd_cells cells;
    hd_nearby near;
    CHECK_OK(hd_cells_create(&cells, &def, 1.0));
    for (int32_t i = 0; i < DISKS; i++) {
        for (int d = 0; d < 2; d++) disks[i].q[d] = cells.box[d] * uniform(&random);
        hd_cells_add(&cells, disks, i);
        for (int d = 0; d < 2; d++) { /* has left the box since */
            disks[i].wrap[d] = below(&random, 5) - 2;
            disks[i].q[d] += disks[i].wrap[d] * cells.box[d];
        }
    }
    for (int32_t i = 0; i < DISKS; i++) {
        hd_nearby_around(&near, &cells, &disks[i]);
        for (int k = 0; k < near.count; k++)
            for (int d = 0; d < 2; d++) {
                const hd_disk *other = &disks[near.disk[k]];
                const double shift = (near.image[d][k] - other->wrap[d]) * cells.box[d];
                const double reach = 2.0 * cells.box[d] / cells.size[d] + 1e-12;
                CHECK_CLOSE(other->q[d] + shift, disks[i].q[d], reach);
            }
    }
    hd_cells_clear(&cells);
}

/* ---- when ---------------------------------------------------------------------------------- */

static void random_disks(hd_disk *disks, hd_random *random)
{
    for (int i = 0; i < DISKS; i++) {
        disks[i] = (hd_disk){.t = uniform(random)};
        for (int d = 0; d < 2; d++) {
            disks[i].q[d] = 4.0 * hd_random_symmetric(random);
            disks[i].p[d] = hd_random_symmetric(random);
            disks[i].wrap[d] = below(random, 3) - 1;
        }
    }
}

static void random_nearby(hd_nearby *near, int count, hd_random *random)
{
    near->count = count;
    for (int k = 0; k < count; k++) {
        near->disk[k] = below(random, DISKS);
        for (int d = 0; d < 2; d++) near->image[d][k] = below(random, 3) - 1;
    }
}

/** Checks all contacts of disk i; returns how many are the earliest. */
static int check_contacts(hd_nearby *near, const hd_disk *disks, int32_t i)
{
    const double box[2] = {9.0, 7.0};
    double got[HD_NEARBY_MAX + HD_NEARBY_SPARE], least = INFINITY;
    int last = -1, as_early = 0;
    const int first = hd_nearby_contacts(got, near, disks, i, box, NULL);
    for (int k = 0; k < near->count; k++) {
        const hd_disk *b = &disks[near->disk[k]];
        const double shift[2] = {(near->image[0][k] - b->wrap[0]) * box[0],
                                 (near->image[1][k] - b->wrap[1]) * box[1]};
        const double want = one_contact(&disks[i], b, shift, 1.0);
        if (want < INFINITY ? got[k] != want : !isnan(got[k]))
            fail_msg("contact %d of %d at %.17g, wanted %.17g", k, near->count, got[k], want);
        as_early = want < least ? 1 : as_early + (want == least && want < INFINITY);
        if (want < least) least = want, last = k;
    }
    if (as_early == 0) assert_int_equal(first, HD_NEARBY_NONE);
    if (as_early > 1) assert_int_equal(first, HD_NEARBY_TIED);
    if (as_early == 1 && first != HD_NEARBY_TIED) assert_int_equal(first, last);
    return as_early;
}

TEST(contacts_are_those_of_single_pairs)
{
    static hd_disk disks[DISKS];
    hd_random random = hd_random_seeded(6, 0);
    hd_nearby near;
    int with[3] = {0, 0, 0};
    for (int round = 0; round < 200; round++) {
        random_disks(disks, &random);
        for (int count = 0; count <= HD_NEARBY_MAX; count++) {
            random_nearby(&near, count, &random);
            const int as_early = check_contacts(&near, disks, below(&random, DISKS));
            with[as_early < 2 ? as_early : 2]++;
        }
    }
    assert_true(with[0] > 100 && with[1] > 1000);
}

/** The earliest twice, at any two places. */
TEST(ties_are_told)
{
    static hd_disk disks[DISKS];
    hd_random random = hd_random_seeded(7, 0);
    const double box[2] = {9.0, 7.0};
    double contact[HD_NEARBY_MAX + HD_NEARBY_SPARE];
    int ties = 0;
    for (int round = 0; round < 3000; round++) {
        hd_nearby near;
        random_disks(disks, &random);
        random_nearby(&near, 2 + below(&random, HD_NEARBY_MAX - 1), &random);
        const int32_t i = below(&random, DISKS);
        const int first = hd_nearby_contacts(contact, &near, disks, i, box, NULL);
        if (first < 0) continue;
        const int place = (first + 1 + below(&random, near.count - 1)) % near.count;
        near.disk[place] = near.disk[first];
        for (int d = 0; d < 2; d++) near.image[d][place] = near.image[d][first];
        assert_true(check_contacts(&near, disks, i) == 2);
        ties++;
    }
    assert_true(ties > 1000);
}

/** Touching within rounding while approaching: at once; while parting, or at rest: never. */
TEST(touching_disks_meet_at_once)
{
    const double box[2] = {9.0, 9.0}, closer = 1.0 - 2.0 * DBL_EPSILON;
    const hd_disk disks[] = {{.q = {0, 0}, .p = {1, 0}, .t = 0.25},
                             {.q = {1.0 + 0.25, 0}, .p = {0, 0}, .t = 0.25},
                             {.q = {closer, 0}, .p = {0, 0}, .t = 0.25},
                             {.q = {-closer, 0}, .p = {0, 0}, .t = 0.25},
                             {.q = {closer, 0}, .p = {1, 0}, .t = 0.25}};
    hd_nearby near = {.count = 4, .disk = {2, 3, 4, 0}};
    double contact[HD_NEARBY_MAX + HD_NEARBY_SPARE];
    assert_int_equal(hd_nearby_contacts(contact, &near, disks, 0, box, NULL), 0);
    assert_true(contact[0] == 0.25);
    for (int k = 1; k < 4; k++) assert_true(isnan(contact[k]));
    near.disk[0] = 1;
    assert_int_equal(hd_nearby_contacts(contact, &near, disks, 0, box, NULL), 0);
    assert_true(contact[0] == 0.5);
}

/** Past each other at exactly a diameter: no contact; a little closer: one. */
TEST(grazing_disks_pass)
{
    const double box[2] = {9.0, 9.0};
    const hd_disk disks[] = {
        {.p = {1, 0}}, {.q = {3.0, 1.0}}, {.q = {3.0, -1.0}}, {.q = {3.0, 1.0 - DBL_EPSILON}}};
    hd_nearby near = {.count = 3, .disk = {1, 2, 3}};
    double contact[HD_NEARBY_MAX + HD_NEARBY_SPARE];
    assert_int_equal(hd_nearby_contacts(contact, &near, disks, 0, box, NULL), 2);
    assert_true(isnan(contact[0]) && isnan(contact[1]));
    assert_true(contact[2] > 2.9 && contact[2] < 3.0);
}
