"""The P mode reconstructed from the vectors of an LP step: noise, until it is divided by the
momenta."""

import numpy as np

from .. import steps, waves
from .box import enclose
from .pattern import pattern
from .style import BLUE, GREY, VERMILION, plt, titled

CUT = 2.5  # amplitudes shown: where a momentum is tiny, the quotient is not
EPSILON = 1e-2  # of the mean square of a momentum component, in the quotients: HD_PMODE_EPSILON
TINY = 1e-30  # a momentum of 0 has no weight, as its quotient is 0 too
NOISE = 4.0  # root mean squares shown of the mode itself


def draw(recording):
    field = chosen(recording)
    if field is None:
        return None
    mode = PMode(field, clearest(field), recording.info)
    figure, grid = plt.subplots(
        2,
        2,
        figsize=(7.2, 4.6 if mode.along else 6.2),
        sharex=True,
        sharey='row' if mode.along else True,
        constrained_layout=True,
    )
    panel = _curve if mode.along else _map
    for column, axis in enumerate('xy'):
        panel(grid[0, column], mode, mode.raw[column], NOISE, f'$\\phi_{{P,{axis}}}$')
        amplitude = mode.amplitude(column)
        panel(
            grid[1, column],
            mode,
            mode.divided[column],
            CUT,
            f'$\\phi_{{P,{axis}}} / p_{axis}$, fit ${amplitude:.2f}\\,{mode.formula[1:]}',
        )
        if mode.along:
            _modulation(grid[1, column], mode, amplitude)
    _label(grid, mode)
    said = (
        f', {mode.name}, $t={field.sim_time:g}$: P mode with $A={mode.formula[1:]}\n'
        'above as measured, below divided by the momenta'
    )
    return titled(figure, recording.info, more=said)


def chosen(recording):
    """The field with P modes of the lowest resolved LP step; a wave along an axis, if any, is
    clearer."""
    numbers = (
        {
            (step.nx, step.ny): order
            for order, (_, step) in enumerate(steps.resolved_lp(recording.steps))
        }
        if recording.steps is not None
        else {}
    )
    fields = [
        field for field in recording.fields() if field.pairs and (field.nx, field.ny) in numbers
    ]
    return min(
        fields,
        default=None,
        key=lambda field: (
            field.nx > 0 and field.ny > 0 and not waves.is_round(recording.info),
            numbers[field.nx, field.ny],
            -field.sim_time,
        ),
    )


def clearest(field):
    """Number of the pair whose P mode is best."""
    return int(np.argmin(field.residual_p))


class PMode:
    """One pair of a field: the P mode and its quotient by the momenta, component by component."""

    def __init__(self, field, pair, info):
        part = slice(pair * len(field.x), (pair + 1) * len(field.x))
        raw = np.array([field.p_x[part], field.p_y[part]])
        self.raw = raw / np.sqrt(np.mean(raw**2))
        self.divided = np.array([field.p_over_px[part], field.p_over_py[part]])
        self.bits = field.modulation[pair]
        self.name = steps.wave_name('LP', field)
        self.formula = waves.formula(field.nx, field.ny, self.bits)
        along = 'x' if field.ny == 0 else 'y' if field.nx == 0 else None
        self.along = None if waves.is_round(info) else along
        self._field, self.info = field, info
        self.x, self.y = np.array(field.x), np.array(field.y)
        self._p = np.array([field.px, field.py])

    @property
    def place(self):
        return self.x if self.along == 'x' else self.y

    @property
    def length(self):
        return self.info.box_x if self.along == 'x' else self.info.box_y

    def modulation(self, x, y):
        wave = self._field
        if waves.is_round(self.info):
            return waves.round_modulation(self.info, wave.wave_number, wave.nx, self.bits, x, y)
        return waves.modulation(self.info, wave.nx, wave.ny, self.bits, x, y)

    def amplitude(self, component):
        """Of A in a quotient, by least squares: its noise is as large as the momentum is small."""
        return self.fit(component).amplitude

    def fit(self, component, divided=True):
        """Of A to a quotient, or to the mode itself, whose noise is alike everywhere."""
        a = self.modulation(self.x, self.y)
        if not divided:
            return Fit(a, self.raw[component], np.ones_like(a))
        # p^2 / (p^2 + eps): what the division has left of A
        p2 = self._p[component] ** 2
        more = p2 + EPSILON * np.mean(self._p**2)
        return Fit(a * p2 / more, self.divided[component], more**2 / np.maximum(p2, TINY))


class Fit:
    """values = amplitude A + noise, by weighted least squares."""

    def __init__(self, a, values, weights):
        self.amplitude = np.sum(weights * a * values) / np.sum(weights * a * a)
        rest = np.sum(weights * (values - self.amplitude * a) ** 2)
        # of the amplitude, if the noise at one disk knows nothing of the next
        self.error = np.sqrt(rest / (len(a) - 1) / np.sum(weights * a * a))
        # of the values, their root mean square being 1
        self.scatter = np.sqrt(rest / np.sum(weights * values**2))


def _curve(axes, mode, values, limit, name):
    """Against the coordinate along the wave."""
    axes.axhline(0, color=GREY, linewidth=0.5)
    size = min(6.0, max(1.0, 2.5 * np.sqrt(780 / len(values))))
    axes.plot(mode.place, values, '.', color=BLUE, markersize=size)
    axes.set_ylim(-limit, limit)
    axes.set_xlim(0, mode.length)
    outside = int(np.sum(np.abs(values) > limit))
    note = f'  ({outside} of {len(values)} outside)' if outside else ''
    axes.set_title(name + note, loc='left', fontsize=8)


def _modulation(axes, mode, amplitude):
    place = np.linspace(0, mode.length, 300)
    axes.plot(place, amplitude * mode.modulation(place, place), color=VERMILION)


def _map(axes, mode, values, limit, name):
    pattern(axes, mode.x, mode.y, values, limit)
    enclose(axes, mode.info)
    axes.set_title(name, loc='left', fontsize=8)


def _label(grid, mode):
    for axes in grid[-1]:
        axes.set_xlabel(rf'${mode.along or "x"}$  [$\sigma$]')
    for row in grid if not mode.along else ():
        row[0].set_ylabel(r'$y$  [$\sigma$]')
