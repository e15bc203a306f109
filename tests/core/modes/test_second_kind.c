/** The share of each vector that is on particles of the second kind. */
#include "mixed.h"
#include "modes/modes.h"

enum { COUNT = 16, SECOND = 6, VECTORS = 4, ROWS = 4 };

/** Of vectors made by hand: one particle of each kind, both, a dp alone; other rows do not count.
 */
TEST(the_second_kind_has_a_share_of_each_vector)
{
    static const double want[VECTORS] = {1.0, 0.0, 0.36, 0.0};
    double v[ROWS * COUNT][VECTORS] = {{0.0}}, q[2 * COUNT], p[2 * COUNT];
    hd_scene_def def = mixed(HD_DISKS, 0.3, (double)SECOND / COUNT, 1.3, 3.0);
    def.number = COUNT;
    MADE(hd_modes, modes, &def, VECTORS, 1);
    for (int k = 0; k < 2 * COUNT; k++) q[k] = p[k] = 0.5 + 0.37 * k;
    v[ROWS * 10][0] = -0.7; /* the first of them */
    v[ROWS * 9 + 1][1] = 0.2;
    v[ROWS * 3][2] = 0.8, v[ROWS * 15 + 1][2] = 0.6;
    v[ROWS * 15 + 2][2] = v[ROWS * 12 + 3][2] = 9.0;
    v[ROWS * 12 + 2][3] = 1.0;
    CHECK_OK(hd_modes_measure(modes, (hd_columns){&v[0][0], VECTORS, 0, VECTORS}, q, p));
    hd_modes_add(modes);
    for (int l = 0; l < VECTORS; l++) {
        CHECK_CLOSE(hd_modes_share_snapshot(modes, HD_SHARE_SECOND)[l], want[l], 1e-14);
        CHECK_CLOSE(hd_modes_share_average(modes, HD_SHARE_SECOND)[l], want[l], 1e-14);
    }
    assert_null(hd_modes_share_average(modes, HD_SHARE_TURNING));
    const hd_scene_def pure = mixed(HD_DISKS, 0.3, 0.0, 1.3, 3.0),
                       other = mixed(HD_DISKS, 0.3, 1.0, 1.3, 3.0);
    MADE(hd_modes, of_first, &pure, VECTORS, 1);
    MADE(hd_modes, of_second, &other, VECTORS, 1);
    assert_null(hd_modes_share_average(of_first, HD_SHARE_SECOND));
    assert_null(hd_modes_share_average(of_second, HD_SHARE_SECOND));
}
