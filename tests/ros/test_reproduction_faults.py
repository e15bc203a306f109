"""Each statement of the reproduction turns red by a fault of the program that is planted in what it
recorded of a made world."""
# Second tier: tests/run.sh --all

import fnmatch
import functools
import unittest

import numpy as np

from made import LP, T
from planted import (
    answers,
    backwards,
    behind,
    beside,
    directions,
    drifting,
    each,
    entry,
    exchanged,
    faster_runs,
    gas,
    higher,
    lines,
    mistaken,
    more,
    of_t,
    other_modulation,
    pairs_exchanged,
    phases,
    right_angle,
    scaled,
    shifted,
    smaller,
    spectra,
    standing,
    steps,
    to_the_walls,
    trembling,
    turned,
    two_below,
    widths,
)
from reproduced import PARTS, Bag, messages_of, of_part, plan, world

AGREES, DIFFERS = 'agrees', 'differs'


def verdicts(bags, parts=PARTS):
    """{statement: verdict}, of those that are judged."""
    found = [one for part in parts for one in part.claims(of_part(part, bags))]
    return {one.name: one.verdict for one in found if one.judged}


@functools.lru_cache(None)
def usual():
    return verdicts(world())


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
    bags = {**world(), **{name: Bag(change(messages_of(name)), name) for name in names}}
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


if __name__ == '__main__':
    unittest.main()
