"""The reproduction over a made world: each statement turns red by a fault of the program that is
planted in what it recorded; numbers are those of the world; every number, table and figure stays
what it is in reproduction_made.txt, which `python3 test_reproduction.py --write` writes anew."""
# Second tier: tests/run.sh --all

import fnmatch
import functools
import os
import re
import sys
import unittest
from math import sqrt
from unittest import mock

import numpy as np

import damaged
import made
import reproduced
from damaged import of, step
from drawn import digest, means
from hdlyap.plots import paper
from hdlyap.plots.figures.style import STYLE, plt
from made import LP, T
from reproduced import PARTS, Bag, messages_of, plan

GOLDEN = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'reproduction_made.txt')
NUMBER = re.compile(r'[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?')
DRIFT = 1e-5  # relative: of numbers on another machine
NOISE = 1e-11  # what is zero but for rounding
SIGMAS = 4.5
AGREES, DIFFERS = 'agrees', 'differs'


@functools.lru_cache(None)
def world():
    return {name: Bag(messages_of(name)) for name in plan()}


def of_part(part, bags):
    return {name: bags[name] for name in part.runs}


def verdicts(bags, parts=PARTS):
    """{statement: verdict}, of those that are judged."""
    found = [one for part in parts for one in part.claims(of_part(part, bags))]
    return {one.name: one.verdict for one in found if one.judged}


@functools.lru_cache(None)
def usual():
    return verdicts(world())


# ---- faults of a program, as they change the messages of a run -----------------------------------


def steps(change):
    """Of every step that was found."""

    def fault(messages):
        for one in of(messages, 'Steps')[-1].steps:
            if one.resolved and one.kind in (T, LP):
                change(messages[0], one)
        return messages

    return fault


def each(kind, change):
    """Of every message of a kind, by its number."""

    def fault(messages):
        for number, message in enumerate(of(messages, kind)):
            change(message, number)
        return messages

    return fault


def phases(change):
    """Of every phase of an LP step: change(phase, time)."""
    return each(
        'LpPhases', lambda message, _: [change(one, message.sim_time) for one in message.phases]
    )


def scaled(name, factor, kind=None):
    def change(info, one):
        if kind in (None, one.kind):
            setattr(one, name, factor * getattr(one, name))

    return steps(change)


def exchanged(info, one):
    one.kind = {T: LP, LP: T}[one.kind]


def to_the_walls(info, one):
    """k without the diameter that the centres do not reach."""
    if 'reflecting' in (info.boundary_x, info.boundary_y):
        one.wave_number = float(np.pi * np.hypot(one.nx / info.box_x, one.ny / info.box_y))


def shifted(info, one):
    one.first_index, one.last_index = one.first_index + 1, one.last_index + 1


def higher(info, one):
    """T as the density inside would have it."""
    if one.kind == T and 'reflecting' in (info.boundary_x, info.boundary_y):
        inside = reproduced.pressure.inside(info)
        one.exponent *= paper.slope_t(inside) / paper.slope_t(info.density)


def turned(factor, *waves):
    """Rates of these waves, or of all."""

    def change(one, time):
        if not waves or (one.nx, one.ny) in waves:
            turn(one, one.phase + (factor - 1) * one.omega * time)

    return phases(change)


def turn(one, phase):
    z = np.hypot(one.a, one.b) * np.exp(1j * phase)
    one.a, one.b, one.phase = z.real, z.imag, phase


def trembling(one, time):
    turn(one, one.phase + np.sin(0.5 * time))


def backwards(one, time):
    turn(one, -one.phase)


def smaller(one, time):
    one.a, one.b = 0.9 * one.a, 0.9 * one.b


def standing(one, time):
    """Cosine and sine turn together."""
    turn(one, one.omega * time)


def pairs_exchanged(one, time):
    one.a, one.b = one.b, one.a


def behind(one, time):
    z = complex(one.a, one.b) * np.exp(0.07j)
    one.a, one.b = z.real, z.imag


def right_angle(field, _):
    field.dqx, field.dqy = field.dqy, -field.dqx
    if field.pairs:
        field.l_x, field.l_y = field.l_y, -field.l_x


def mistaken(field, _):
    field.kind = {T: LP, LP: T}[field.kind]


def other_modulation(field, _):
    if (field.nx, field.ny) == (1, 0):
        field.modulation = bytes(field.modulation)[::-1]


def spectra(change):
    """Of the exponents, in every message."""

    def fault(message, _):
        message.exponents = np.array(message.exponents)
        change(message.exponents)

    return each('Spectrum', fault)


def entry(name, index, value):
    def fault(message, _):
        values = np.array(getattr(message, name))
        values[index] = value(values[index]) if callable(value) else value
        setattr(message, name, values)

    return fault


def two_below(messages):
    """Exponents smaller than those of LP(1,0), where walls allow none."""
    for message in of(messages, 'Spectrum'):
        values = np.array(message.exponents)
        message.exponents = np.concatenate([values[2:], [0.5 * values[-1]] * 2])

    def change(info, one):
        one.first_index, one.last_index = one.first_index - 2, one.last_index - 2

    return steps(change)(messages)


def gas(**factors):
    def change(message, _):
        for name, factor in factors.items():
            setattr(message, name, factor * getattr(message, name))

    return each('Gas', change)


def answers(kind, name, change):
    def fault(message, _):
        for one in message.responses:
            if one.kind == kind:
                setattr(one, name, change(one))

    return each('Hydro', fault)


def beside(value):
    """C with this beside its diagonal."""

    def fault(messages):
        with mock.patch.object(reproduced, 'SYMMETRIC', value):
            return messages_of('hydro')

    return fault


def widths(change):
    def fault(message, _):
        message.widths = change(np.array(message.widths), message)

    return each('Localization', fault)


def of_t(value):
    def fault(messages):
        one = step(messages, T, 1, 0)
        return widths(lambda w, _: np.where(np.arange(1, len(w) + 1) >= one.first_index, value, w))(
            messages
        )

    return fault


def lines(of_lp=1.0, of_t=0.0):
    """Rates of the vectors' waves over v k."""

    def fault(messages):
        name = 'structure_' + messages[0].boundary_x
        v = of(messages, 'Steps')[-1].v
        return reproduced.structure(reproduced.Run(name), omega=(of_lp * v, of_t * v))

    return fault


def directions(message, _):
    message.along, message.across = message.across, message.along


def drifting(message, _):
    for phase in message.phases:
        phase.omega += 0.02


def faster_runs(messages):
    for message in of(messages, 'Spectrum'):
        message.exponents, message.ks_entropy = 1.02 * message.exponents, 1.02 * message.ks_entropy
    return scaled('exponent', 1.02)(messages)


def more(messages):
    """Exponents of steps, in steps and spectrum."""
    for message in of(messages, 'Spectrum'):
        message.exponents = 1.04 * np.array(message.exponents)
    return scaled('exponent', 1.04)(messages)


ALL, WALLS, BOXES = '*', '*reflecting*|*walls*', 'smallest_*|aspect_*|density_04'


def red(starts='', green=''):
    """{beginning of a statement: its verdict}"""
    verdicts = (DIFFERS, starts), (AGREES, green)
    return {one: verdict for verdict, some in verdicts for one in some.split('; ') if one}


# what, runs, what it does to their messages, statements that turn red (or from red to green)
FAULTS = (
    (
        'exponents 4 % too large',
        ALL,
        more,
        red('exponents of the; c_T follows; c_L follows; v is close; lambda_T =; lambda_L ='),
    ),
    (
        'exponents 4 % too small',
        ALL,
        scaled('exponent', 0.96),
        red('exponents of the; c_T follows; c_L follows; v is close; lambda_T =; lambda_L ='),
    ),
    (
        'T and L exchanged',
        ALL,
        steps(exchanged),
        red(
            'indices of the; indices of T(2,0); exponents of the; c_T follows; '
            'c_L follows; c_T is above; c_T and v; lambda_T =; lambda_L =; '
            'c2 of L is; every step; vectors of; the line of LP; a T mode is'
        ),
    ),
    (
        'k up to the walls',
        ALL,
        steps(to_the_walls),
        red(
            'one curve; lambda_T is; lambda_L is; '
            'slopes do not depend on the aspect ratio, reflecting; the line of LP'
        ),
    ),
    (
        'indices one too large',
        'periodic',
        steps(shifted),
        red('indices of the; indices of T(2,0); exponents of a'),
    ),
    (
        'an exponent of a step is off',
        'periodic',
        spectra(lambda values: values.__setitem__(-2, 1.03 * values[-2])),
        red('exponents of a; every step'),
    ),
    (
        'cosine below the zero modes',
        'halves',
        each('Spectrum', entry('cos_theta', 1556, 0.9)),
        red('cos Theta'),
    ),
    (
        'one zero mode less',
        'halves',
        each('Spectrum', entry('exponents', 1557, 0.5)),
        red('the zero exponents'),
    ),
    (
        'ratio of a conjugate',
        'halves',
        each('Spectrum', entry('dp_dq_ratio', -9, lambda one: 2 * one)),
        red("C' of the"),
    ),
    (
        'a pair whose sum is not zero',
        'halves',
        each('Spectrum', entry('exponents', 900, lambda one: one + 1e-6)),
        red('exponents are'),
    ),
    (
        'arrows turned by a right angle',
        'periodic',
        each('ModeField', right_angle),
        red('T and LP modes; T modes are free; L modes are'),
    ),
    (
        'fields of T and L exchanged',
        'periodic',
        each('ModeField', mistaken),
        red('T and LP modes; T modes are free'),
    ),
    (
        'modulations exchanged',
        'periodic',
        each('ModeField', other_modulation),
        red('phi_P,x /; phi_P is not'),
    ),
    (
        'P along y is larger',
        'periodic',
        each('ModeField', entry('p_over_py', slice(None), lambda one: 1.2 * one)),
        red('phi_P,x /'),
    ),
    (
        'vectors that are no rotation',
        'periodic',
        each('ModeField', lambda one, _: setattr(one, 'rotation_distance', 0.9)),
        red('the vectors'),
    ),
    ('a quarter that is 3.20', 'reflecting', turned(2.984 / 3.2, (1, 0)), red(green='3.20 is a')),
    ('modes that turn from P to L', 'reflecting', phases(backwards), red('an L mode')),
    ('coefficients inside of the circle', 'reflecting', phases(smaller), red('a^2 + b^2')),
    ('omega not in proportion to k', 'periodic', turned(1.02, (0, 1)), red('omega is in')),
    ('uneven phases', 'periodic', phases(trembling), red('phases turn')),
    ('T modes that move', 'periodic', each('TPhases', drifting), red('T modes are stationary')),
    (
        'c_L that is smaller at high density',
        'density_0[78]',
        scaled('exponent', 0.85, LP),
        red('c_L follows; c_T and v'),
    ),
    ('rates of LP modes 12 % too large', 'density_*', scaled('omega', 1.12), red('v is close')),
    (
        'rates of LP modes 16 % too small',
        'density_*',
        scaled('omega', 0.84),
        red('v is close; v is above'),
    ),
    (
        'curvature of L gone',
        BOXES,
        steps(
            lambda info, one: setattr(
                one, 'exponent', one.exponent - 0.55 * (one.kind == LP) * one.wave_number**2
            )
        ),
        red('c_T and v; lambda_L =; c2 of L is'),
    ),
    (
        'one box off, between walls',
        'smallest_reflecting_600_075',
        scaled('exponent', 1.05),
        red('one curve'),
    ),
    (
        'walls 2 % off',
        'smallest_reflecting_*',
        scaled('exponent', 1.02),
        red('lambda_T is; lambda_L is'),
    ),
    (
        'walls 5 % off at 0.2',
        'walls_02',
        scaled('exponent', 1.05),
        red('the same is true at density 0.2'),
    ),
    (
        'walls 5 % off at 0.8',
        'reflecting',
        scaled('exponent', 1.05),
        red('the same is true at density 0.8'),
    ),
    (
        'one aspect ratio off',
        'aspect_050_*',
        scaled('exponent', 1.03),
        red(
            'slopes do not depend on the aspect ratio, periodic; '
            'slopes do not depend on the aspect ratio, reflecting'
        ),
    ),
    (
        'T is higher between walls',
        'smallest_reflecting_*|reflecting',
        steps(higher),
        red('lambda_T is', green='a guess: T'),
    ),
    ('two exponents below LP(1,0)', 'reflecting', two_below, red('T(1,0) and')),
    (
        'a zero exponent that does not vanish',
        'zeros_mixed',
        each('Spectrum', entry('exponents', 198, 0.6)),
        red('6, 4 or 2'),
    ),
    (
        'a and b exchanged',
        'hydro',
        phases(pairs_exchanged),
        red('T excites; dp = C dq; dp of LP modes is'),
    ),
    (
        'T excites density',
        'hydro',
        answers(T, 'density', lambda one: 0.3 * one.across),
        red('T excites'),
    ),
    (
        'C larger on L',
        'hydro',
        answers(LP, 'along', lambda one: 1.3 * one.along),
        red('dp = C dq; dp of LP modes is'),
    ),
    ('dp behind dq', 'hydro', phases(behind), red('T excites; dp of LP modes is')),
    ('L and P lag the other way', 'hydro', beside(0.04), red('dp of LP modes lags')),
    ('standing waves', 'travelling', phases(standing), red('the L part')),
    ('long intervals 2 % off', 'independent_8_*', faster_runs, red('exponents do')),
    (
        'an interval that loses digits',
        'interval_2',
        spectra(lambda values: values.__setitem__(300, values[300] + 3e-8)),
        red('one trajectory'),
    ),
    ('an interval with other indices', 'interval_1', steps(shifted), red('one trajectory')),
    ('structure along for across', 'structure_*', each('Structure', directions), red('vectors of')),
    ('lines of LP 4 % too fast', 'structure_*', lines(of_lp=1.04), red('the line of LP')),
    ('lines of T that move', 'structure_*', lines(of_t=0.3), red('the line of T')),
    (
        'widths all alike',
        'hydro',
        widths(lambda one, _: np.full(len(one), 0.6)),
        red('the vector of; a T mode is'),
    ),
    (
        'widths the other way round',
        'hydro',
        widths(lambda one, _: np.append(one[:30][::-1], one[30:])),
        red('the vector of; the larger'),
    ),
    ('T spread evenly', 'hydro', of_t(1.0), red('a T mode is')),
    (
        'pressures 2 % too large',
        'density_*',
        gas(compressibility=1.02, pressure=1.02),
        red(
            'pressures are; disks collide; v is P / (sqrt(2); v goes to 0.988; '
            'v goes to the; LP modes turn alike in; LP modes turn alike between'
        ),
    ),
    ('collisions counted twice', 'density_*', gas(collision_rate=2.0), red('disks collide')),
    ('v 5 % off at one density', 'density_03', turned(0.95), red('v is P / (sqrt(2)')),
    (
        'v 4 % off in one box',
        'aspect_075_periodic',
        turned(1.04),
        red('v of all boxes is one curve in k, periodic'),
    ),
    (
        'v 4 % off in one box between walls',
        'aspect_075_walls_t',
        turned(1.04),
        red('v of all boxes is one curve in k, between'),
    ),
    ('v 3 % off between walls', WALLS, turned(1.03), red('v goes to the; v is alike')),
    (
        'v 3 % off in periodic boxes',
        'smallest_periodic_*|aspect_*_periodic|density_04|periodic',
        turned(1.03),
        red('v goes to 0.988; v is alike'),
    ),
    ('v 5 % off in narrow boxes', 'narrow_*', turned(0.95), red('LP modes turn alike in')),
    (
        'v 4 % off between walls at 0.2',
        'walls_02',
        turned(1.04),
        red('LP modes turn alike between'),
    ),
)


def touched(pattern):
    return [
        name for name in plan() if any(fnmatch.fnmatch(name, one) for one in pattern.split('|'))
    ]


def turned_by(fault):
    """{statement: its verdict} of those that turn red, or from red to green."""
    _, pattern, change, _ = fault
    names = touched(pattern)
    bags = {**world(), **{name: Bag(change(messages_of(name))) for name in names}}
    found = verdicts(bags, [part for part in PARTS if set(names) & set(part.runs)])
    turned = {name: one for name, one in found.items() if one != usual()[name]}
    return {name: one for name, one in turned.items() if one in (AGREES, DIFFERS)}


class Faults(unittest.TestCase):
    def test_none(self):
        """But for the paper's 3.20, and for a guess of ours that T modes do not follow."""
        off = {name for name, verdict in usual().items() if verdict == DIFFERS}
        names = (
            '3.20 is a quarter of a period',
            'a guess: T between walls is higher, as it is denser inside',
        )
        self.assertEqual(off, set(names))
        self.assertNotIn('not measured', usual().values())

    def test_each_turns_its_statements(self):
        turned_once = set()
        for fault in FAULTS:
            found = turned_by(fault)
            turned_once |= set(found)
            expected = {
                name: verdict
                for start, verdict in fault[3].items()
                for name in usual()
                if name.startswith(start)
            }
            with self.subTest(fault[0]):
                self.assertEqual(found, expected)
        self.assertEqual(turned_once, set(usual()))


# ---- numbers -------------------------------------------------------------------------------------

K = made.wave_number(reproduced.info_of('periodic'), 1, 0)
V = reproduced.velocity(reproduced.info_of('periodic'), (1, 0))
OF_WALLS = reproduced.info_of('reflecting')
RATE = made.wave_number(OF_WALLS, 1, 0) * reproduced.velocity(OF_WALLS, (1, 0))
ETA = 0.2 * np.pi / 4
HENDERSON = (1 + ETA**2 / 8) / (1 - ETA) ** 2
TRUTH = {
    'exponent of LP(1,0)': 1.015 * paper.slope_l(0.8) * K,
    'c_T of lambda = c k + c2 k^2': paper.slope_t(0.8),
    'c_T2 of lambda = c k + c2 k^2': 0.0,
    'ratio of the amplitudes on A': 1.0,
    'quarter period of LP(1,0)': np.pi / 2 / RATE,
    'omega of LP(1,0), reflecting': RATE,
    'a^2 + b^2 of LP(1,0), mean': reproduced.STRENGTH * (1 + reproduced.SWAY**2 / 2),
    'omega / k of LP(1,0)': V,
    'v, common': V,
    'c_T at density 0.5': paper.slope_t(0.5),
    'c_L at density 0.1': paper.slope_l(0.1),
    'v - c_L at density 0.5': reproduced.velocity(reproduced.info_of('density_05'), (1, 0))
    - paper.slope_l(0.5),
    'c_T - c_L at density 0.2': paper.slope_t(0.2) - paper.slope_l(0.2),
    'c of lambda_T': 1.412,
    'c2 of lambda_T': 0.086,
    'c of lambda_L': 1.422,
    'c2 of lambda_L': 0.55,
    'c2 of lambda_L less c2 of lambda_T': 0.55 - 0.086,
    'C on L over C on P, of dp = C dq': 0.51 / 0.8 / (1.45 / 0.8 / sqrt(8)),
    'the same at L less that mean': 2 * reproduced.SYMMETRIC / (0.51 / 0.8 + 1.45 / 0.8 / sqrt(8)),
    'angle of dp ahead of dq, mean of a turn': 0.0,
    'front velocity / (omega / k), same times': 1.0,
    'omega / k of LP(1,0), same run': V,
    'omega / v k of LP(1,0), periodic': 1.0,
    'width of T(1,0), as a wave': 2 / np.e + 0.001,
    'mean free path at density 0.2': ETA / (sqrt(2) * 0.2 * (HENDERSON - 1)),
    'v over P / (sqrt 2 rho) at k = 0, periodic, density 0.4': reproduced.START,
    'v over P / (sqrt 2 rho) at k = 0, between walls, density 0.4': reproduced.START,
    'v: walls over periodic at equal k, less 1, density 0.4': 0.0,
    'p of bulk': 1.0,
    'p of lambda_1': 1.0,
    '2 samples joined, bulk': 1.0,
}


class Numbers(unittest.TestCase):
    def test_of_the_world(self):
        """Within the errors that they state."""
        found = {}
        for part in PARTS:
            rows = [row for one in part.claims(of_part(part, world())) for row in one.rows]
            names = [row.quantity for row in rows]
            self.assertEqual(len(names), len(set(names)), part.title)
            found.update(zip(names, rows))
        for name, truth in TRUTH.items():
            row = found[name]
            with self.subTest(name):
                self.assertTrue(row.error > 0)
                self.assertLessEqual(abs(row.measured - truth), SIGMAS * row.error)

    def test_of_a_bag_without_its_topics(self):
        """Nothing is measured, drawn or judged."""
        known = {'width of a random vector'}
        bags = {name: Bag([bag.info, made.cost(1.0)]) for name, bag in world().items()}
        for part in PARTS:
            of_it = of_part(part, bags)
            rows = [row for one in part.claims(of_it) for row in one.rows]
            names = {row.quantity for row in rows if row.verdict != 'not measured'}
            self.assertLessEqual(names, known, part.title)
            self.assertEqual(list(part.figures(of_it)), [])
            for _, header, lines in part.tables(of_it):
                self.assertEqual({len(line) for line in lines} - {len(header)}, set())


# ---- all that is said, written and drawn ---------------------------------------------------------


def summary(bags):
    """Lines of text."""
    with plt.rc_context(STYLE):
        for part in PARTS:
            of_it = of_part(part, bags)
            yield f'{part.number}. {part.title}'
            for claim in part.claims(of_it):
                yield f'{claim.verdict}: {claim.name} ({claim.values})'
                yield from ('  ' + ' | '.join(map(str, row.values())) for row in claim.rows)
            for name, header, lines in part.tables(of_it):
                yield f'table {name}: {len(lines)}'
                yield from (f'  {one}: {_column(cells)}' for one, *cells in zip(header, *lines))
            for name, figure in part.figures(of_it):
                yield f'figure {name}'
                yield from digest(figure)
                plt.close(figure)


def _column(cells):
    """Mean of its numbers and of neighbours' products; how many texts."""
    texts = [str(one) for one in cells if not NUMBER.fullmatch(str(one))]
    numbers = np.array([float(one) for one in cells if NUMBER.fullmatch(str(one))])
    said = f'{len(numbers)} {means(numbers)}' if len(numbers) else ''
    return f'{said} {" ".join(dict.fromkeys(texts))[:60]}'.strip()


def written():
    worlds = world(), {name: Bag(damaged.messages(name)) for name in plan()}
    for bags in worlds:
        yield from (line.rstrip().replace('\n', '; ') for line in summary(bags))


def is_alike(one, other):
    """But for the last digit of a number, and for what is only rounding."""
    if NUMBER.sub('#', one) != NUMBER.sub('#', other):
        return False
    return all(map(_are_alike, NUMBER.findall(one), NUMBER.findall(other)))


def _are_alike(one, other):
    a, b = float(one), float(other)
    mantissa, _, power = max(one, other, key=len).partition('e')
    decimals = len(mantissa.partition('.')[2]) or int(bool(power))
    last = 10.0 ** (int(power or 0) - decimals)
    exact = not set('.e') & set(one + other)
    return one == other if exact else abs(a - b) <= 1.01 * last + DRIFT * abs(a) + NOISE


class Everything(unittest.TestCase):
    def test_is_as_it_was(self):
        with open(GOLDEN) as file:
            before = file.read().splitlines()
        now = list(written())
        off = [f'{one}\n  now: {two}' for one, two in zip(before, now) if not is_alike(one, two)]
        self.assertEqual(off, [], '--write makes it anew, once each of these is understood')
        self.assertEqual(len(before), len(now))

    def test_what_is_alike(self):
        for one, other, expected in (
            ('v 1.2345 of 3', 'v 1.2346 of 3', True),
            ('v 1.2345 of 3', 'v 1.2349 of 3', False),
            ('indices 5-6', 'indices 5-7', False),
            ('a 1.0', 'b 1.0', False),
            ('7.1e-03', '7.2e-03', True),
            ('7.1e-03', '7.4e-03', False),
            ('2e-08', '1e-08', False),
            ('3.1e-17', '2e-15', True),
        ):
            self.assertEqual(is_alike(one, other), expected)


if __name__ == '__main__':
    if '--write' in sys.argv:
        with open(GOLDEN, 'w') as file:
            file.writelines(line + '\n' for line in written())
    else:
        unittest.main()
