"""What Eckmann, Forster, Posch, Zabey, "Lyapunov modes in hard-disk systems", J. Stat. Phys.
(2005), gives: steps of its periodic scene (N = 780, density 0.8, aspect ratio 0.867), slopes of the
branches, and at density 0.4 their curvature."""

from collections import namedtuple
from math import hypot, inf, isclose, pi

from hdlyap.data import space
from hdlyap.data.reader import is_known

DISKS, DENSITY, ASPECT = 780, 0.8, 0.867
FIT_ACCURACY = 0.03  # relative accuracy of the slopes of the fits, as we assume
FITS = 'fits of Eckmann, Forster, Posch, Zabey 2005'
# kind, nodes, first and last index; indices of the last two follow from their multiplicities
INDICES = (
    ('T', 1, 0, 1556, 1557),
    ('T', 0, 1, 1554, 1555),
    ('LP', 1, 0, 1550, 1553),
    ('T', 1, 1, 1546, 1549),
    ('LP', 0, 1, 1542, 1545),
    ('T', 2, 0, 1540, 1541),
    ('LP', 1, 1, 1532, 1539),
)
STEPS = INDICES[:5]  # wave numbers are small enough for slopes without curvature
# lambda = c k + c2 k^2; c2 is None if only a slope is given


class Branch(namedtuple('Branch', 'c c2')):
    @property
    def coefficients(self):
        return [value for value in self if value is not None]

    @property
    def terms(self):
        """The number of terms of its form."""
        return len(self.coefficients)


CURVES = {'T': Branch(1.412, 0.086), 'LP': Branch(1.422, 0.55)}
CURVES_DENSITY = 0.4
# Ranges of the paper's boxes; its slopes are not compared with those of other boxes.
CURVES_DISKS, FIT_DISKS, FIT_DENSITIES, ASPECTS = (400, 800), (400, inf), (0.1, DENSITY), (0.5, 1.0)


class Step:
    """Degenerate exponents of one wave vector, with the value of the fitted branch, c k."""

    def __init__(self, info, kind, nx, ny, first, last):
        slope = slope_t if kind == 'T' else slope_l
        self.kind, self.nx, self.ny, self.first, self.last = kind, nx, ny, first, last
        self.name = f'{kind}({nx},{ny})'
        self.wave_number = 2 * pi * hypot(nx / info.box_x, ny / info.box_y)
        self.fitted = slope(info.density) * self.wave_number


def slope_t(density):
    """c_T at N = 780, A = 0.867, density <= 0.8."""
    return 0.902 + 1.050 * density - 0.053 * density**2 + 3.85 * density**4


def slope_l(density):
    """c_L at N = 780, A = 0.867, density <= 0.8."""
    return 0.790 + 0.970 * density + 0.785 * density**2 + 6.24 * density**4


def steps(info):
    """The paper's smallest steps if the run has the paper's periodic scene, otherwise none."""
    if not _is_periodic_scene(info):
        return []
    return [Step(info, *step) for step in STEPS]


def branches(info):
    """{kind: Branch} of the paper's fits that hold for the run."""
    if not _is_rectangle(info) or not _within(info.aspect, ASPECTS):
        return {}
    if isclose(info.density, CURVES_DENSITY, rel_tol=1e-6) and _within(info.number, CURVES_DISKS):
        return CURVES
    if _within(info.density, FIT_DENSITIES) and _within(info.number, FIT_DISKS):
        return {'T': Branch(slope_t(info.density), None), 'LP': Branch(slope_l(info.density), None)}
    return {}


def _within(value, ends):
    return ends[0] * (1 - 1e-6) <= value <= ends[1] * (1 + 1e-6)


def _is_rectangle(info):
    if not is_known(info) or info.particles != 'disks' or info.container != 'rectangle':
        return False
    return space.are_units(info) and not space.shear(info)


def _is_periodic_scene(info):
    return (
        _is_rectangle(info)
        and info.number == DISKS
        and isclose(info.density, DENSITY, rel_tol=1e-6)
        and isclose(info.aspect, ASPECT, rel_tol=1e-6)
        and info.boundary_x == info.boundary_y == 'periodic'
    )
