"""Two recordings -> what the runs share, and the deviations of all that both have measured."""

import copy
import io

from . import steps
from .deviation import Deviation
from .recording import RecordingError

SAME = 1e-9  # relative: parameters that were given as the same decimal number
SYSTEM = ('density', 'aspect', 'boundary_x', 'boundary_y')
OWN = ('header', 'run_id')  # of every message, also of bit-identical runs
FITS = (
    ('c_t', steps.T, 't_points'),
    ('c_t2', steps.T, 't_points'),
    ('c_l', steps.LP, 'l_points'),
    ('c_l2', steps.LP, 'l_points'),
    ('v', None, 'v_phases'),
)


class Comparison:
    """Of the runs a and b. With as many disks in both: exponents, h_KS, steps, fits; else the fits
    alone, since exponents belong to wave numbers that depend on N."""

    def __init__(self, a, b):
        self.runs = a, b
        self.same_disks = a.info.disks == b.info.disks
        _refuse_other_systems(a.info, b.info)
        (_refuse_without_exponents if self.same_disks else _refuse_without_steps)(a, b)
        self.exponents = _exponents(a, b) if self.same_disks else []
        self.sums = [_sum(a, b)] if self.same_disks and len(self.exponents) > 1 else []
        self.steps = _steps(a, b) if self.same_disks else []
        self.fits = _fits(a, b, self.same_disks)

    @property
    def deviations(self):
        return [*self.exponents, *self.sums, *self.steps, *self.fits]

    @property
    def is_identical(self):
        """Every bit of what both have of the last spectrum and the last steps."""
        a, b = self.runs
        pairs = [(a.spectrum, b.spectrum), (a.steps, b.steps)]
        both = [pair for pair in pairs if None not in pair]
        return bool(both) and all(_bits(one) == _bits(other) for one, other in both)

    @property
    def found_once(self):
        """Names of the steps that are resolved in only one of the runs: (in a, in b)."""
        a, b = (_resolved(run) for run in self.runs)
        return (
            [_step_name(a[key]) for key in a if key not in b],
            [_step_name(b[key]) for key in b if key not in a],
        )

    @property
    def parameters(self):
        """(name, value of a, value of b) where they differ."""
        a, b = (run.info for run in self.runs)
        for name in dict.fromkeys([*a.__slots__, *b.__slots__]):
            # bags of other versions do not know every parameter
            values = [getattr(info, name, '-') for info in (a, b)]
            if name not in OWN and values[0] != values[1]:
                yield name, *values


def _bits(message):
    message = copy.copy(message)
    message.header, message.run_id = type(message.header)(), ''
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def _refuse_other_systems(a, b):
    for name in SYSTEM:
        values = getattr(a, name), getattr(b, name)
        same = (
            values[0] == values[1]
            if isinstance(values[0], str)
            else abs(values[0] - values[1]) <= SAME * abs(values[0])
        )
        if not same:
            raise RecordingError(
                'the runs cannot be compared: ' f'{name} is {values[0]} and {values[1]}'
            )


def _refuse_without_exponents(a, b):
    for run, which in ((a, 'first'), (b, 'second')):
        if run.spectrum is None:
            raise RecordingError(f'no averaged spectrum in the {which} bag')
    carried = [(run.spectrum.first_index, run.last_index) for run in (a, b)]
    if carried[0] != carried[1]:
        raise RecordingError(
            'the runs cannot be compared: exponents {}-{} and {}-{}'.format(
                *carried[0], *carried[1]
            )
        )


def _refuse_without_steps(a, b):
    if not all(run.steps and (run.steps.t_points or run.steps.l_points) for run in (a, b)):
        raise RecordingError(
            f'the runs cannot be compared: disks are {a.info.disks} and '
            f'{b.info.disks}, and only fits over steps could be; not both bags '
            'have one'
        )


def _exponents(a, b):
    zeros = range(a.positive_end + 1, a.positive_end + a.info.zero_exponents + 1)
    columns = zip(
        a.spectrum.exponents, b.spectrum.exponents, a.spectrum.std_errors, b.spectrum.std_errors
    )
    return [
        Deviation(
            'lambda_max' if index == 1 else f'lambda_{index}',
            values[:2],
            values[2:],
            # they fall like 1/t, and their errors are not those of a mean
            judged=index not in zeros,
        )
        for index, values in enumerate(columns, start=a.spectrum.first_index)
    ]


def _sum(a, b):
    """Of the positive exponents."""
    return Deviation(
        a.sum_name, (a.spectrum.ks_entropy, b.spectrum.ks_entropy), (a.sum_error, b.sum_error)
    )


def _resolved(run):
    """{what it is: Step} of the resolved steps, smallest |exponent| first."""
    found = [step for step in (run.steps.steps if run.steps else ()) if step.resolved]
    return {
        (step.kind, step.nx, step.ny, step.conjugate): step
        for step in sorted(found, key=lambda step: abs(step.exponent))
    }


def _step_name(step):
    return steps.name(step) + ('*' if step.conjugate else '')


def _steps(a, b):
    """Deviations of the steps that both runs resolve; their origins are the two Steps."""
    in_a, in_b = _resolved(a), _resolved(b)
    pairs = [(in_a[key], in_b[key]) for key in in_a if key in in_b]
    return [
        Deviation(
            _step_name(pair[0]),
            [step.exponent for step in pair],
            [step.std_error for step in pair],
            judged=pair[0].kind != steps.ZERO,
            origins=pair,
        )
        for pair in pairs
    ]


def _fits(a, b, same_disks):
    """Deviations of the fits that both runs have; their origins are the numbers of points. A curve
    through other points need not be the same: with as many disks only fits over the same steps are
    judged. (v is no curve and of no kind of step.)"""
    if a.steps is None or b.steps is None:
        return []
    deviations = []
    for name, kind, points in FITS:
        counts = [getattr(run.steps, points) for run in (a, b)]
        if min(counts) < (2 if name.endswith('2') else 1):
            continue
        judged = not same_disks or _waves(a, kind) == _waves(b, kind)
        deviations.append(
            Deviation(
                name[0] + name[1:].upper(),
                [getattr(run.steps, name) for run in (a, b)],
                [getattr(run.steps, name + '_error') for run in (a, b)],
                judged,
                counts,
            )
        )
    return deviations


def _waves(run, kind):
    """What a fit goes through."""
    return {key for key in _resolved(run) if key[0] == kind and not key[3]}
