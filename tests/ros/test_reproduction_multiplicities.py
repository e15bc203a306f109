"""Part 11 of the reproduction: the rule against fields that are sampled, rows against runs that are
known exactly."""
# Second tier: tests/run.sh --all

import itertools
import os
import tempfile
import unittest
from math import log
from unittest import mock

import numpy as np

import made
import recorded
from made import LP, T
import reproduced
from study.bags import Bag
from study.parts import multiplicities as part

PERIODIC, WALLS = 'periodic', 'reflecting'
OF_BOXES = part.counted, part.steps_found


def sampled_rank(info, kind, nx, ny):
    """Dimension of the fields of a step at many disks: derivatives of A by hand, and p A."""
    rng = np.random.default_rng(1)
    x, y = rng.uniform(0, 1, (2, 300))
    p = rng.normal(size=(2, 300))
    fields = []
    for (a, da), (b, db) in itertools.product(
        _functions(nx, info.boundary_x, kind, x), _functions(ny, info.boundary_y, kind, y)
    ):
        gradient = np.array([da * b, a * db])
        fields += [[gradient[1], -gradient[0]]] if kind == T else [gradient, p * (a * b)]
    if not fields:
        return 0
    return np.linalg.matrix_rank(np.reshape(fields, (len(fields), -1)), tol=1e-9)


def _functions(n, boundary, kind, q):
    """(A, dA/dq) of one coordinate in 0 .. 1."""
    k = (2 if boundary == PERIODIC else 1) * np.pi * n
    cosine = np.cos(k * q) + 0 * q, -k * np.sin(k * q)
    sine = np.sin(k * q), k * np.cos(k * q)
    if boundary == PERIODIC:
        return [cosine, sine]
    return [sine] if kind == T else [cosine]


class Rule(unittest.TestCase):
    def test_against_the_rank_of_sampled_fields(self):
        for boundaries in itertools.product((PERIODIC, WALLS), repeat=2):
            info = recorded.info(400, 0.4, 0.867, boundaries=boundaries)
            for kind, nx, ny in itertools.product((T, LP), range(3), range(3)):
                if nx or ny:
                    self.assertEqual(
                        part.prescribed(info, kind, nx, ny),
                        sampled_rank(info, kind, nx, ny),
                        (boundaries, kind, nx, ny),
                    )

    def test_the_papers_numbers(self):
        both, walls, mixed = (
            recorded.info(400, 0.4, 0.867, boundaries=boundaries)
            for boundaries in ((PERIODIC, PERIODIC), (WALLS, WALLS), (PERIODIC, WALLS))
        )
        for info, kind, nodes, count in (
            (both, T, (1, 1), 4),
            (both, LP, (1, 1), 8),
            (both, T, (1, 0), 2),
            (both, LP, (0, 1), 4),
            (walls, T, (1, 1), 1),
            (walls, T, (1, 0), 0),
            (walls, LP, (1, 0), 2),
            (walls, LP, (1, 1), 2),
            (mixed, T, (0, 1), 1),
            (mixed, T, (1, 0), 0),
            (mixed, LP, (1, 0), 4),
            (mixed, LP, (0, 1), 2),
            (mixed, T, (1, 1), 2),
            (mixed, LP, (1, 1), 4),
        ):
            self.assertEqual(part.prescribed(info, kind, *nodes), count)

    def test_narrow(self):
        info = recorded.info(150, 0.5, 0.0075)
        self.assertEqual(part.prescribed(info, LP, 3, 0), 4)
        self.assertEqual(part.prescribed(info, LP, 0, 1), 0)
        self.assertEqual(part.prescribed(info, T, 1, 1), 0)


def run(levels, *made_steps, aspect=0.867, boundaries=(PERIODIC, PERIODIC)):
    """A run of 100 disks (197 positive exponents) with stairs and steps: (kind, nx, ny, first,
    last, more)."""
    info = recorded.info(100, 0.7, aspect, boundaries=boundaries)
    spectrum = recorded.stairs(info, levels)
    found = [made.step(info, *step[:5], **step[5]) for step in made_steps]
    for step in found:
        inside = slice(
            step.first_index - spectrum.first_index, step.last_index + 1 - spectrum.first_index
        )
        step.exponent = float(np.mean(spectrum.exponents[inside]))
    return recorded.Recorded(
        info, made.steps([*found, made.unresolved(info, LP, 2, 2, 8), made.zero_modes()]), spectrum
    )


def usual(boundaries=(PERIODIC, PERIODIC)):
    end = 199 - boundaries.count(PERIODIC)  # half of the zero exponents are behind it
    return run(
        [(0.6, 2), (0.9, 4), (1.2, 2)],
        (T, 1, 0, end - 1, end, {'multiplicity': 1.93}),
        (LP, 1, 0, end - 5, end - 2, {'multiplicity': 3.39}),
        (T, 0, 1, end - 7, end - 6, {}),
        boundaries=boundaries,
    )


class Rows(unittest.TestCase):
    def rows(self, found):
        with mock.patch.object(part, 'BOXES', {'one': 'box'}):
            bags = {'one': recorded.Bag(found)}
            return {row.quantity: row for of in OF_BOXES for row in of(bags)}

    def test_counted(self):
        rows = self.rows(usual())
        for name, count, remark in (
            ('T(1,0)', 2, 'trace 1.93'),
            ('LP(1,0)', 4, 'trace 3.39'),
            ('T(0,1)', 2, 'trace 1.98'),
        ):
            row = rows[f'box: {name}']
            self.assertEqual(
                (row.published, row.measured, row.remark, row.verdict),
                (count, count, remark, 'agrees'),
            )
        self.assertEqual(
            (rows['box: steps found'].measured, rows['box: steps found'].remark),
            (3, 'not resolved: LP(2,2)'),
        )

    def test_steps_that_share_their_vectors(self):
        shared = {'set': 7, 'members': 2}
        rows = self.rows(
            run(
                [(0.6, 4), (0.9, 8)],
                (T, 1, 0, 194, 197, shared),
                (T, 0, 1, 194, 197, shared),
                (LP, 1, 0, 186, 189, {}),
                (LP, 0, 1, 190, 193, {}),
                aspect=1.0,
            )
        )
        self.assertEqual(
            (rows['box: T(1,0) + T(0,1)'].published, rows['box: T(1,0) + T(0,1)'].measured), (4, 4)
        )
        # one stair, though in two sets
        (name,) = [name for name in rows if 'LP' in name]
        self.assertEqual((rows[name].published, rows[name].measured), (8, 8))

    def test_a_step_with_other_vectors_on_its_stair_is_not_counted(self):
        rows = self.rows(
            run([(0.6, 2), (0.9, 5)], (T, 1, 0, 196, 197, {}), (LP, 1, 0, 192, 195, {}))
        )
        row = rows['box: LP(1,0)']
        self.assertEqual((row.verdict, row.published), ('not measured', 4))
        self.assertIn('goes on without a jump in the other exponents of 191-195', row.remark)

    def test_a_broken_stair_has_pieces(self):
        rows = self.rows(
            run(
                [(0.6, 2), (0.9, 3), (1.1, 1), (1.5, 1)],
                (T, 1, 0, 196, 197, {}),
                (LP, 1, 0, 192, 195, {}),
            )
        )
        row = rows['box: LP(1,0)']
        self.assertEqual((row.measured, row.verdict), ('3 + 1', 'differs'))
        self.assertIn('192-195 are no stair', row.remark)
        self.assertEqual(rows['box: T(1,0)'].verdict, 'agrees')

    def test_a_broken_stair_without_errors_may_be_whole(self):
        found = run(
            [(0.6, 2), (0.9, 3), (1.1, 1), (1.5, 1)],
            (T, 1, 0, 196, 197, {}),
            (LP, 1, 0, 192, 195, {}),
        )
        found.spectrum.std_errors = [-1.0] * len(found.spectrum.exponents)
        rows = self.rows(found)
        row = rows['box: LP(1,0)']
        self.assertEqual((row.measured, row.verdict), (None, 'not measured'))
        self.assertTrue(row.remark.endswith('are no stair, with errors that are not known'))
        self.assertEqual(rows['box: T(1,0)'].verdict, 'agrees')

    def test_a_broken_stair_among_unknown_neighbours_is_not_counted(self):
        rows = self.rows(
            run([(0.6, 2), (0.9, 3), (1.1, 3)], (T, 1, 0, 196, 197, {}), (LP, 1, 0, 192, 195, {}))
        )
        self.assertEqual(rows['box: LP(1,0)'].verdict, 'not measured')
        self.assertIn('other exponents of 190-195', rows['box: LP(1,0)'].remark)

    def test_vectors_of_one_step_on_the_stair_of_another(self):
        """Three equal exponents where the rule has two, and three where it has four: the neighbours
        are known."""
        rows = self.rows(
            run(
                [(0.6, 3), (0.9, 3), (1.3, 2)],
                (T, 1, 0, 196, 197, {}),
                (LP, 1, 0, 192, 195, {}),
                (T, 0, 1, 190, 191, {}),
            )
        )
        row = rows['box: T(1,0) + LP(1,0)']
        self.assertEqual((row.published, row.measured, row.verdict), (6, '3 + 3', 'differs'))
        self.assertEqual(rows['box: T(0,1)'].verdict, 'agrees')

    def test_against_the_rule_and_not_the_node(self):
        """A node that took four vectors for a step of two, and said that four are expected."""
        rows = self.rows(run([(0.6, 4)], (T, 1, 0, 194, 197, {'expected': 4})))
        self.assertEqual((rows['box: T(1,0)'].published, rows['box: T(1,0)'].measured), (2, 4))
        self.assertEqual(rows['box: T(1,0)'].verdict, 'differs')

    def test_without_steps(self):
        rows = self.rows(recorded.Recorded(made.run_info()))
        self.assertEqual({row.verdict for row in rows.values()}, {'not measured'})


def zero_rows(bag, count):
    with mock.patch.object(part, 'ZEROS', {'one': (count, 'so')}):
        return [row for of in (part.vanishing, part.zero_modes) for row in of({'one': bag})]


class Zeros(unittest.TestCase):
    """Through bags: 40 exponents of 10 disks, some of which vanish like ln(t)/t."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, 'run.bag')

    def bag(self, count, size=0.5, with_steps=True, warmup=20.0):
        half = np.linspace(3, 1, 20 - count // 2)
        messages = [made.run_info(disks=10, zero_exponents=count, warmup=warmup)]
        for time in (10.0, 30.0, 100.0):
            small = (
                size
                * log((20 + time) / 20 if warmup else time)
                / time
                * np.linspace(1, 0.1, count // 2)
            )
            messages.append(made.spectrum([*half, *small, *-small[::-1], *-half[::-1]], time))
        if with_steps:
            zero = made.zero_modes(21 - count // 2)
            zero.last_index = 20 + count // 2
            messages.append(made.steps([zero], averaged_time=100.0))
        made.write(self.path, messages)
        return Bag(self.path)

    def test_counted(self):
        for count in (6, 4, 2):
            number, trace, size = zero_rows(self.bag(count), count)
            self.assertEqual((number.measured, number.verdict), (count, 'agrees'))
            self.assertIn(
                f'indices {21 - count // 2}-{20 + count // 2}, smaller than 0.18; the next is 1',
                number.remark,
            )
            self.assertEqual((trace.measured, trace.verdict), (6.0, ''))  # of made.zero_modes
            self.assertEqual(trace.remark, f'vectors {21 - count // 2}-{20 + count // 2}')
            self.assertAlmostEqual(size.measured, 0.5)
            self.assertEqual(
                size.remark, 'w = 20, the warm-up; 0.5 at t = 10, 0.5 at t = 30, 0.5 at t = 100'
            )

    def test_without_a_warm_up(self):
        size = zero_rows(self.bag(4, warmup=0.0), 4)[-1]
        self.assertAlmostEqual(size.measured, 0.5)

    def test_another_number_differs(self):
        number, _, _ = zero_rows(self.bag(4), 6)
        self.assertEqual((number.measured, number.verdict), (4, 'differs'))

    def test_exponents_that_do_not_vanish(self):
        number, _, _ = zero_rows(self.bag(6, size=15.0), 6)
        self.assertEqual(number.verdict, 'differs')

    def test_without_steps_or_spectrum(self):
        number, mode, _ = zero_rows(self.bag(6, with_steps=False), 6)
        self.assertEqual((number.verdict, mode.verdict), ('agrees', 'not measured'))
        made.write(self.path, [made.run_info(), made.cost(1.0)])
        self.assertEqual(
            [row.verdict for row in zero_rows(Bag(self.path), 6)], ['not measured'] * 3
        )


def bags():
    walls = usual(boundaries=(WALLS, WALLS))
    boxes = {name: recorded.Bag(walls if name == 'reflecting' else usual()) for name in part.BOXES}
    spectra = [made.spectrum([3.0, 1.0, 0.02, -0.01], time) for time in (10.0, 100.0)]
    zero = recorded.Recorded(made.run_info(), None, spectra[-1])
    return {**boxes, **{name: recorded.Bag(zero, spectra) for name in part.ZEROS}}


class Whole(unittest.TestCase):
    def test_the_runs_are_those_of_the_plan(self):
        self.assertEqual(sorted(bags()), sorted(reproduced.part_of(part).runs))

    def test_none_below_the_longest_lp_mode(self):
        """T(1,0), which walls do not have, would be smaller."""
        alone = run([(0.6, 2), (0.9, 1)], (LP, 1, 0, 198, 199, {}), boundaries=(WALLS, WALLS))
        for found, count, verdict in (
            (alone, 0, 'agrees'),
            (usual(boundaries=(WALLS, WALLS)), 2, 'differs'),
            (recorded.Recorded(made.run_info()), None, 'not measured'),
        ):
            (row,) = part.none({part.WALLED: recorded.Bag(found)})
            self.assertEqual((row.measured, row.judge({}).verdict), (count, verdict))

    def test_every_box_has_rows(self):
        rows = recorded.by_quantity(part, bags())
        for box in part.BOXES.values():
            self.assertIn(f'{box}: LP(1,0)', rows)
        self.assertEqual(
            rows['zero exponents, both directions reflecting'].verdict, 'agrees'
        )  # two of made
        self.assertEqual(rows['zero exponents, both directions periodic'].verdict, 'differs')

    def test_tables(self):
        (_, header, lines), (_, _, zeros) = part.tables(bags())
        self.assertEqual(len(lines), 4 * len(part.BOXES))
        line = dict(zip(header, lines[1]))
        self.assertEqual(
            (line['step'], line['prescribed'], line['trace'], line['first_index']),
            ('LP(1,0)', 4, '3.390', 192),
        )
        self.assertEqual(dict(zip(header, lines[3]))['resolved'], 'no')
        self.assertEqual(zeros[-1][:2], ('both directions reflecting', '100'))
        self.assertAlmostEqual(float(zeros[-1][2]), 0.02)
        self.assertAlmostEqual(float(zeros[-1][3]), log(100) / 100, places=4)

    def test_figure(self):
        self.assertEqual(recorded.pictures(self, part, bags()), ['stairs'])

    def test_boxes_without_anything(self):
        bare = {
            name: recorded.Bag(recorded.Recorded(made.run_info()))
            for name in reproduced.part_of(part).runs
        }
        self.assertEqual({row.verdict for row in recorded.rows(part, bare)}, {'not measured'})
        self.assertEqual(recorded.pictures(self, part, bare), [])
        self.assertEqual([lines for _, _, lines in part.tables(bare)], [[], []])


if __name__ == '__main__':
    unittest.main()
