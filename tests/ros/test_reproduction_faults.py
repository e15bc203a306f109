"""What a wrong program would have turned red: the claims that differ when the recorded numbers of
the last full run (doc/reproduction), or made ones, are made wrong in one way."""
# Second tier: tests/run.sh --all

import re
import unittest

import numpy as np

import made
import recorded
import test_reproduction_fields
import test_reproduction_hydro
import test_reproduction_multiplicities
import test_reproduction_p_mode
from made import LP, T
from reproduced import Part
from study.parts import aspect, densities, fields, hydro, multiplicities, p_mode, smallest, spectrum

KINDS = {'T': T, 'LP': LP}
ALIKE = {f'{symbol} is alike for both boundaries' for symbol in ('lambda_T', 'lambda_L')}
ASPECT = 'slopes do not depend on the aspect ratio, {}'
FITS = [f"{symbol} follows the paper's fit" for symbol in ('c_T', 'c_L')]
CURVES = ['lambda_T = 1.412 k + 0.086 k^2', 'lambda_L = 1.422 k + 0.55 k^2']
FIELDS = (
    'T and LP modes are the vector fields of their wave vectors',
    'T modes are free of divergence',
    'L modes are free of rotation, reconstructed from the vectors of an LP step',
)
CK = 'exponents of the five smallest steps are c k, with c of the fits at density 0.8'


# ---- faults: of one step of a run ----------------------------------------------------------------


def larger(info, step):
    """Exponents 3 % too large, as if the fits were 3 % too small."""
    step.exponent *= 1.03


def smaller(info, step):
    step.exponent *= 0.97


def exchanged(info, step):
    """T and L."""
    step.kind = {T: LP, LP: T}[step.kind]


def to_the_walls(info, step):
    """k between walls without the -1."""
    if info.boundary_x == 'reflecting':
        nodes = step.nx / info.box_x, step.ny / info.box_y
        step.wave_number = float(np.pi * np.hypot(*nodes))


def none(info, step):
    """As it was recorded."""


# ---- recorded numbers ----------------------------------------------------------------------------


def bag_of(info, found, fault):
    for step in found:
        fault(info, step)
    return recorded.Bag(recorded.Recorded(info, made.steps(found)))


def step_of(info, name, first, line, count=2):
    """name: T(1,0), or several of a square box, of which the first stands for all."""
    kind, nx, ny = re.match(r'(T|LP)\((\d+),(\d+)\)', name).groups()
    last = first + count - 1
    exponent, error = float(line['exponent']), float(line['std_error'])
    return made.step(
        info, KINDS[kind], int(nx), int(ny), first, last, exponent=exponent, std_error=error
    )


def of_spectrum(fault):
    info = made.paper_info()
    found = []
    for line in recorded.table('11_multiplicities'):
        if line['box'] == 'periodic' and line['resolved'] == 'yes' and line['members'] == '1':
            first, last = int(line['first_index']), int(line['last_index'])
            found.append(step_of(info, line['step'], first, line, last - first + 1))
    return {'periodic': bag_of(info, found, fault)}


def of_densities(fault):
    bags = {}
    for name, line in zip(densities.RUNS, recorded.table('08_densities')):
        density = float(line['density'])
        info = recorded.info(780, density, 0.867)
        k = made.wave_number(info, 1, 0)
        found = [
            made.step(
                info,
                kind,
                1,
                0,
                first,
                first + 1,
                exponent=k * float(line[column]),
                std_error=k * float(line[f'{column}_error']),
            )
            for kind, column, first in ((T, 'c_t', 1556), (LP, 'c_l', 1550))
        ]
        phases = made.lp_phases(info, found, 50.0)
        made.turn(found, k * float(line['v']), k * float(line['v_error']))
        bags[name] = bag_of(info, found, fault)
        bags[name].recording.phases.add(phases)
    return bags


def of_smallest(fault):
    shapes = {
        (400, '0.5'): '400_05',
        (400, '1'): '400_1',
        (600, '0.75'): '600_075',
        (780, '0.5'): '780_05',
        (780, '0.867'): '780_0867',
        (780, '1'): '780_1',
    }
    lines = {}
    for line in recorded.table('09_smallest'):
        box = shapes[int(line['disks']), line['aspect']]
        lines.setdefault((line['boundaries'], box), []).append(line)
    bags = {}
    for (boundary, box), both in lines.items():
        info = recorded.info(
            int(both[0]['disks']), 0.4, float(both[0]['aspect']), (boundary, boundary)
        )
        found = [
            step_of(info, line['step'], 100 * number, line)
            for number, line in enumerate(both, start=1)
            if line['exponent'] and 'shares' not in line['remark']
        ]
        bags[smallest.run_of(boundary, box)] = bag_of(info, found, fault)
    return bags


def of_aspect(fault):
    lines = {}
    for line in recorded.table('10_aspect'):
        lines.setdefault((line['boundaries'], line['disks'], line['aspect']), []).append(line)
    bags = {}
    for (boundary, disks, ratio), both in lines.items():
        info = recorded.info(int(disks), 0.4, float(ratio), (boundary, boundary))
        found = [
            step_of(info, line['step'], 100 * number, line)
            for number, line in enumerate(both, start=1)
            if line['exponent']
        ]
        which = 'periodic' if boundary == 'periodic' else 'walls_t' if both[1:] else 'walls_lp'
        bags[f'aspect_{round(100 * float(ratio)):03d}_{which}'] = bag_of(info, found, fault)
    return bags


RECORDED = (
    (spectrum, of_spectrum),
    (densities, of_densities),
    (smallest, of_smallest),
    (aspect, of_aspect),
)


def differ(fault):
    """Claims of all parts that do."""
    return {
        name
        for part, bags in RECORDED
        for name, verdict in recorded.verdicts(part, bags(fault)).items()
        if verdict == 'differs'
    }


class Recorded(unittest.TestCase):
    """The lists are those of doc/reproduction.md."""

    def turned(self, fault):
        return differ(fault) - differ(none)

    def test_as_recorded(self):
        """What differs in the last full run: not what is tested here."""
        self.assertFalse(differ(none) & {*FITS, *CURVES, *ALIKE})

    def test_exponents_that_are_off(self):
        for fault in (larger, smaller):
            self.assertEqual({*FITS, *CURVES, CK}, self.turned(fault), fault)

    def test_t_and_l_exchanged(self):
        turned = self.turned(exchanged)
        self.assertLessEqual(
            {
                'indices of the five smallest steps, and the step of vector 1535',
                'indices of T(2,0) and LP(1,1), by their multiplicities beside what is stated',
                CK,
                *FITS,
                *CURVES,
            },
            turned,
        )

    def test_wave_numbers_to_the_walls(self):
        turned = self.turned(to_the_walls)
        self.assertLessEqual(ALIKE, turned)
        # what has no walls stays
        self.assertFalse(turned & {*FITS, ASPECT.format('periodic')})


class Made(Part):
    """Whole bags, of what is not in the tables."""

    def verdicts(self, part, name, messages):
        return recorded.verdicts(part, {name: self.bag(name, messages)})

    def test_multiplicities_of_t_and_l_exchanged(self):
        """The rule then prescribes others."""
        usual = test_reproduction_multiplicities.usual
        boxes = {name: recorded.Bag(usual()) for name in multiplicities.BOXES}
        bags = {**test_reproduction_multiplicities.bags(), **boxes}
        rule = 'every step has as many exponents as the boundaries allow modulations'
        self.assertEqual(recorded.verdicts(multiplicities, bags)[rule], 'agrees')
        for name in multiplicities.BOXES:
            for step in bags[name].recording.steps.steps:
                step.kind = {T: LP, LP: T}.get(step.kind, step.kind)
        self.assertEqual(recorded.verdicts(multiplicities, bags)[rule], 'differs')

    def test_fields_of_t_and_l_exchanged(self):
        info = made.run_info()
        found = test_reproduction_fields.Fields().found(info)
        for fault, verdict in ((none, 'agrees'), (exchanged, 'differs')):
            messages = [info]
            for step in found:
                letters = ('T', 'TL') if step.kind == T else ('L', 'TL')
                if (step.nx, step.ny) == (1, 0):
                    for t in (150.0, 170.0):
                        messages.append(
                            test_reproduction_fields.field(info, step, 0.9, *letters, t)
                        )
                        fault(info, messages[-1])
            claims = self.verdicts(fields, 'periodic', messages)
            self.assertEqual([claims[name] for name in FIELDS[:2]], 2 * [verdict])

    def test_arrows_turned_by_a_right_angle(self):
        """Of a gradient that makes a curl, and the other way."""
        info = made.run_info()
        for turned, verdict in ((False, 'agrees'), (True, 'differs')):
            messages = [info]
            for step, letter in zip(test_reproduction_fields.Fields().found(info), 'TL'):
                for t in (150.0, 170.0):
                    one = test_reproduction_fields.field(info, step, 0.9, letter, 'TL', t)
                    one.l_x, one.l_y = (one.pairs * list(part) for part in (one.dqx, one.dqy))
                    if turned:
                        one.dqx, one.dqy = one.dqy, -one.dqx
                        one.l_x, one.l_y = one.l_y, [-part for part in one.l_x]
                    messages.append(one)
            claims = self.verdicts(fields, 'periodic', messages)
            self.assertEqual([claims[name] for name in FIELDS[:3]], 3 * [verdict])

    def test_pairs_swapped(self):
        """P for L: a and b exchanged."""
        for swapped, verdict in ((False, 'agrees'), (True, 'differs')):
            messages = [made.run_info(), *test_reproduction_hydro.Run().messages()]
            for message in messages if swapped else ():
                for phase in getattr(message, 'phases', ()):
                    phase.a, phase.b = phase.b, phase.a
            claims = self.verdicts(hydro, hydro.RUN, messages)
            (table,) = (claims[name] for name in claims if name.startswith('T excites'))
            self.assertEqual(table, verdict)

    def test_modulations_swapped(self):
        """The P mode of the cosine called that of the sine."""
        info = made.run_info()
        smooth = 'phi_P is not smooth, divided by the momenta it is'
        for swapped, verdict in ((False, 'agrees'), (True, 'differs')):
            shown = [
                test_reproduction_p_mode.field(info, (0.7, 0.7), t, 0.1, seed)
                for seed, t in enumerate((150, 170, 190))
            ]
            for field in shown if swapped else ():
                field.modulation = field.modulation[::-1]
            messages = [info, made.steps([made.step(info, LP, 1, 0, 32, 35)]), *shown]
            self.assertEqual(self.verdicts(p_mode, 'periodic', messages)[smooth], verdict)


if __name__ == '__main__':
    unittest.main()
