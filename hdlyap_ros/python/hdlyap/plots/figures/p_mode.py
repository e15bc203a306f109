"""The P mode reconstructed from the vectors of an LP step: noise, until it is divided by the
momenta."""

import numpy as np

from hdlyap.data import containers, space, steps, waves

from . import page
from .box import enclose
from .pattern import SIZE, pattern
from .style import BLUE, GREY, VERMILION

ORDER = 6

CUT = 2.5  # largest quotient that is shown; if a momentum is tiny, the quotient is large
EPSILON = 1e-2  # over the mean square of a momentum component: HD_PMODE_EPSILON
TINY = 1e-30  # makes the weight of a momentum of 0 finite; its quotient is 0, too
INSIDE = 0.95  # part of the particles whose values a map tells apart
NOISE = 4.0  # largest value of the mode that is shown, in root mean squares


@page.figure
def draw(page, recording, **look):
    field = chosen(recording)
    if field is None:
        return
    mode = PMode(field, clearest(field), recording.info)
    directions = space.axes(recording.info)
    size = 7.2 if len(directions) == 2 else 9.6, 4.6 if mode.along else 6.2
    shared = {'sharex': True, 'sharey': 'row' if mode.along else True}
    grid = page.panels(2, len(directions), *size, **shared)
    panel = _curve if mode.along else _map
    for column, axis in enumerate(directions):
        panel(grid[0, column], mode, mode.raw[column], NOISE, f'$\\phi_{{P,{axis}}}$', look)
        amplitude = mode.amplitude(column)
        name = f'$\\phi_{{P,{axis}}} / p_{axis}$, fit ${amplitude:.2f}\\,{mode.formula[1:]}'
        panel(grid[1, column], mode, mode.divided[column], CUT, name, look)
        if mode.along:
            _modulation(grid[1, column], mode, amplitude)
    _label(grid, mode)
    page.outer(grid)
    said = (
        f', {mode.name}, $t={field.sim_time:g}$: P mode with $A={mode.formula[1:]}\n'
        'above as measured, below divided by the momenta'
    )
    page.title(recording.info, *grid.flat, more=said)


def chosen(recording):
    """The field with P modes of the lowest resolved LP step, preferably of a wave along an axis,
    which is clearer."""
    lowest = [step for _, step in steps.resolved_lp(recording.steps)]
    numbers = {space.nodes(step, recording.info): order for order, step in enumerate(lowest)}

    def nodes(field):
        return space.nodes(field, recording.info)

    fields = [field for field in recording.fields() if field.pairs and nodes(field) in numbers]
    return min(
        fields,
        default=None,
        key=lambda field: (
            np.count_nonzero(nodes(field)) > 1 and not containers.is_curved(recording.info),
            numbers[nodes(field)],
            -field.sim_time,
        ),
    )


def clearest(field):
    """The number of the pair whose P mode has the smallest residual."""
    return int(np.argmin(field.residual_p))


class PMode:
    """A pair of a field: the P mode and its quotient by the momenta, component by component."""

    def __init__(self, field, pair, info):
        part = slice(pair * len(field.x), (pair + 1) * len(field.x))
        raw = space.vectors(field, 'p_')[:, part]
        self.raw = raw / np.sqrt(np.mean(raw**2))
        self.divided = space.vectors(field, 'p_over_p')[:, part]
        self.bits, self.nodes = field.modulation[pair], space.nodes(field, info)
        self.name = steps.wave_name('LP', field, info)
        self.formula = waves.formula(*self.nodes[:2], self.bits, *self.nodes[2:])
        named = [axis for axis, n in zip('xyz', self.nodes) if n]
        self.along = named[0] if len(named) == 1 and not containers.is_curved(info) else None
        # the two directions of a map: those on which the mode depends
        self.across = 'xy' if containers.is_curved(info) or len(named) == 1 else named[0] + named[1]
        self._field, self.info = field, info
        self.q = space.vectors(field)
        self._p = space.vectors(field, 'p') / space.roots(info)  # as P modes have them

    @property
    def place(self):
        return self.q['xyz'.index(self.along)]

    @property
    def length(self):
        return getattr(self.info, 'box_' + self.along)

    def modulation(self, x, y, *z):
        wave, (nx, ny, *nz) = self._field, self.nodes
        if containers.is_curved(self.info):
            return containers.modulation(self.info, wave.wave_number, wave.nx, self.bits, x, y)
        return waves.modulation(self.info, nx, ny, self.bits, x, y, *nz, *z)

    def amplitude(self, component):
        """The amplitude of A in a quotient, by least squares. Small momenta have large noise."""
        return self.fit(component).amplitude

    def fit(self, component, divided=True):
        """A fit of A to a quotient, or to the mode itself, whose noise is the same everywhere."""
        a = self.modulation(*self.q)
        if not divided:
            return Fit(a, self.raw[component], np.ones_like(a))
        # the quotient is A p^2 / (p^2 + eps)
        p2 = self._p[component] ** 2
        more = p2 + EPSILON * np.mean(self._p**2)
        return Fit(a * p2 / more, self.divided[component], more**2 / np.maximum(p2, TINY))


class Fit:
    """values = amplitude A + noise, by weighted least squares."""

    def __init__(self, a, values, weights):
        self.amplitude = np.sum(weights * a * values) / np.sum(weights * a * a)
        rest = np.sum(weights * (values - self.amplitude * a) ** 2)
        # error of the amplitude, for independent noise of the particles
        self.error = np.sqrt(rest / (len(a) - 1) / np.sum(weights * a * a))
        # error of the values over their root mean square
        self.scatter = np.sqrt(rest / np.sum(weights * values**2))


def _curve(axes, mode, values, limit, name, look):
    """Draws values over the coordinate along the wave."""
    axes.axhline(0, color=GREY, linewidth=0.5)
    size = min(6.0, max(1.0, 2.5 * np.sqrt(780 / len(values))))
    axes.plot(mode.place, values, '.', **{'color': BLUE, 'markersize': size, **look})
    axes.set_ylim(-limit, limit)
    axes.set_xlim(0, mode.length)
    outside = int(np.sum(np.abs(values) > limit))
    note = f'  ({outside} of {len(values)} outside)' if outside else ''
    axes.set_title(name + note, loc='left', fontsize=8)


def _modulation(axes, mode, amplitude):
    place = np.linspace(0, mode.length, 300)
    axes.plot(place, amplitude * mode.modulation(*[place] * len(mode.q)), color=VERMILION)


def _map(axes, mode, values, limit, name, look):
    x, y = (mode.q['xyz'.index(axis)] for axis in mode.across)
    shown = min(limit, np.quantile(np.abs(values), INSIDE))
    pattern(axes, x, y, values, shown, size=SIZE * max(1, 780 / len(values)), **look)
    enclose(axes, mode.info)
    axes.set_title(name, loc='left', fontsize=8)


def _label(grid, mode):
    for axes in grid.flat:
        axes.set_xlabel(rf'${mode.along or mode.across[0]}$  [$\sigma$]')
        axes.set_ylabel('' if mode.along else rf'${mode.across[1]}$  [$\sigma$]')
