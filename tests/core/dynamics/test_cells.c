/** Cells: neighbours, images and lists, for one, two, three and many columns and both boundaries.
 */
#include "dynamics/hard/cells.h"
#include "base/random.h"
#include "testing.h"

static hd_cells created(int disks, double lx, double ly, hd_boundary boundary)
{
    const hd_scene_def def = scene_in_box(disks, lx, ly, boundary, boundary, 1);
    hd_cells cells;
    CHECK_OK(hd_cells_create(&cells, &def, 1.0));
    return cells;
}

/** As many disks as the box holds one to a diameter: the narrowest cells. */
static hd_cells columns_of(int columns, hd_boundary boundary)
{
    const double edge = columns + 0.5;
    hd_cells cells = created(columns * columns + 2 * columns, edge, edge, boundary);
    assert_int_equal(cells.size[0], columns);
    assert_int_equal(cells.size[1], columns);
    return cells;
}

static void check_line(const hd_cells *cells, int d, const int (*near)[3], const int (*shift)[3])
{
    for (int c = 0; c < cells->size[d]; c++)
        for (int k = 0; k < 3; k++) {
            assert_int_equal(cells->line[d][c].near[k], near[c][k]);
            assert_int_equal(cells->line[d][c].shift[k], shift[c][k]);
        }
}

TEST(neighbours_in_periodic_lines)
{
    const int near1[][3] = {{0, 0, 0}}, shift1[][3] = {{-1, 0, 1}};
    const int near2[][3] = {{1, 0, 1}, {0, 1, 0}}, shift2[][3] = {{-1, 0, 0}, {0, 0, 1}};
    const int near3[][3] = {{2, 0, 1}, {0, 1, 2}, {1, 2, 0}};
    const int shift3[][3] = {{-1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    const int(*near[])[3] = {near1, near2, near3}, (*shift[])[3] = {shift1, shift2, shift3};
    for (int columns = 1; columns <= 3; columns++) {
        hd_cells cells = columns_of(columns, P);
        for (int d = 0; d < 2; d++) check_line(&cells, d, near[columns - 1], shift[columns - 1]);
        hd_cells_clear(&cells);
    }
}

TEST(neighbours_between_walls)
{
    const int near1[][3] = {{1, 0, 1}}, near2[][3] = {{2, 0, 1}, {0, 1, 2}};
    const int near3[][3] = {{3, 0, 1}, {0, 1, 2}, {1, 2, 3}}, shift[3][3] = {{0}};
    const int(*near[])[3] = {near1, near2, near3};
    for (int columns = 1; columns <= 3; columns++) {
        hd_cells cells = columns_of(columns, R);
        for (int d = 0; d < 2; d++) {
            check_line(&cells, d, near[columns - 1], shift);
            assert_true(cells.line[d][0].bound[0] == 0.5);
            assert_true(cells.line[d][columns - 1].bound[1] == cells.box[d] - 0.5);
        }
        hd_cells_clear(&cells);
    }
}

/** Lines leave no gap, and cells are wide enough that contacts stay within neighbours. */
TEST(lines_cover_the_box)
{
    const double edge[] = {1.0 + 1e-9, 1.9, 2.1, 7.3, 123.4, 4e4}, margin = 1e-7;
    for (size_t k = 0; k < sizeof edge / sizeof *edge; k++) {
        hd_cells cells = created(12, 31.0, edge[k], P);
        for (int d = 0; d < 2; d++) {
            const int32_t size = cells.size[d];
            assert_true(cells.line[d][0].bound[0] == 0 &&
                        cells.line[d][size - 1].bound[1] == cells.box[d]);
            for (int32_t c = 0; c < size; c++) {
                const hd_cell_line *l = &cells.line[d][c];
                if (c > 0) assert_true(l->bound[0] == cells.line[d][c - 1].bound[1]);
                assert_true(size == 1 || l->bound[1] - l->bound[0] >= 1.0 + margin);
            }
        }
        hd_cells_clear(&cells);
    }
}

/** Thin gas: about as many cells as disks, however large the box; so memory and search stay small.
 */
TEST(number_of_cells_follows_disks)
{
    const double density[] = {1.0, 0.1, 1e-3, 1e-9}, aspect[] = {1.0, 0.01, 100.0};
    for (int k = 0; k < 12; k++) {
        const hd_scene_def def = scene_of(10000, density[k % 4], aspect[k % 3], P, R, 1);
        hd_cells cells;
        CHECK_OK(hd_cells_create(&cells, &def, 1.0));
        const double count = (double)cells.size[0] * cells.size[1];
        assert_true(count > 0.3 * def.number && count < 2.0 * def.number);
        hd_cells_clear(&cells);
    }
}

static int listed(const hd_cells *cells, int32_t x, int32_t y, int32_t i)
{
    const hd_cell *cell = hd_cells_at(cells, (const int32_t[2]){x, y});
    int found = 0;
    for (int k = 0; k < cell->count; k++) found += cell->disk[k] == i;
    if (!cell->crowded) return found;
    int32_t j = cell->disk[HD_CELL_DISKS - 1];
    while ((j = hd_cells_next(cells, j)) >= 0) found += j == i;
    return found;
}

/** The empty cells beyond the walls included. */
static int listed_anywhere(const hd_cells *cells, int32_t i)
{
    int found = 0;
    for (int32_t x = 0; x <= cells->size[0]; x++)
        for (int32_t y = 0; y <= cells->size[1]; y++) found += listed(cells, x, y, i);
    return found;
}

TEST(disks_are_booked_where_they_are)
{
    enum { N = 200 };
    hd_cells cells = created(N, 25.0, 17.0, P);
    static hd_disk disks[N];
    for (int32_t i = 0; i < N; i++) {
        disks[i] = (hd_disk){.q = {cells.box[0] * (i % 20) / 19.0, cells.box[1] * (i / 20) / 9.0}};
        hd_cells_add(&cells, disks, i); /* both ends of the box included */
    }
    for (int32_t i = 0; i < N; i++) {
        const int32_t *cell = disks[i].cell;
        assert_int_equal(listed_anywhere(&cells, i), 1);
        assert_int_equal(listed(&cells, cell[0], cell[1], i), 1);
        for (int d = 0; d < 2; d++) {
            const hd_cell_line *l = &cells.line[d][cell[d]];
            const double rounding = 4.0 * DBL_EPSILON * cells.box[d];
            assert_true(disks[i].q[d] >= l->bound[0] - rounding &&
                        disks[i].q[d] <= l->bound[1] + rounding);
        }
    }
    hd_cells_clear(&cells);
}

/** Round the box in each direction: back in the first cell, one box edge further. */
TEST(crossing_counts_the_turns)
{
    for (int columns = 1; columns <= 5; columns++)
        for (int k = 0; k < 4; k++) {
            const int d = k % 2, side = k < 2 ? 0 : 2, turn = side - 1;
            hd_cells cells = columns_of(columns, P);
            hd_disk disks[3] = {{.q = {0.25, 0.25}}, {.q = {0.25, 0.25}}, {.q = {0.25, 0.25}}};
            for (int32_t i = 0; i < 3; i++) hd_cells_add(&cells, disks, i);
            for (int step = 0; step < 3 * columns; step++) {
                hd_cells_cross(&cells, disks, 1, d, side);
                assert_int_equal(listed(&cells, disks[1].cell[0], disks[1].cell[1], 1), 1);
                assert_int_equal(listed_anywhere(&cells, 1), 1);
            }
            assert_int_equal(disks[1].cell[d], 0);
            assert_int_equal(disks[1].wrap[d], 3 * turn);
            assert_int_equal(disks[1].wrap[1 - d], 0);
            for (int32_t i = 0; i < 3; i++) assert_int_equal(listed(&cells, 0, 0, i), 1);
            hd_cells_clear(&cells);
        }
}

/** Any number of disks in a cell, joining and leaving in all orders: each is listed where it is,
 * once. */
TEST(crowds_come_and_go)
{
    enum { N = 12, STEPS = 20000 };
    hd_random random = hd_random_seeded(9, 0);
    hd_cells cells = created(N, 40.0, 40.0, P);
    static hd_disk disks[N];
    int fullest = 0;
    for (int32_t i = 0; i < N; i++) {
        disks[i] = (hd_disk){.q = {1.0, 1.0}};
        hd_cells_add(&cells, disks, i);
    }
    for (int step = 0; step < STEPS; step++) {
        const int32_t i = (int32_t)(0.5 * (1.0 + hd_random_symmetric(&random)) * N);
        hd_cells_cross(&cells, disks, i, 0,
                       disks[i].cell[0] == 0 ? 2 : 0); /* to column 1 or back */
        int in_first = 0;
        for (int32_t k = 0; k < N; k++) {
            assert_int_equal(listed_anywhere(&cells, k), 1);
            assert_int_equal(listed(&cells, disks[k].cell[0], 0, k), 1);
            in_first += disks[k].cell[0] == 0;
        }
        fullest = in_first > fullest ? in_first : fullest;
    }
    assert_true(fullest > 2 * HD_CELL_DISKS);
    hd_cells_clear(&cells);
}
