"""Covariant vectors in hdlyap plot, from messages made here: what it prints and draws."""

import os

import numpy as np

from hdlyap.msg import Cost, CovariantAngle, Spectrum, Steps

import bags
import made
from made import LP, T
from hdlyap.plots import covariant, covariant_table, report
from hdlyap.plots.figures import (
    covariant_angles,
    covariant_domination,
    covariant_exponents,
    covariant_vectors,
    covariant_weights,
    fluctuations,
)

FIGURES = {
    'exponents': covariant_exponents,
    'weights': covariant_weights,
    'angles': covariant_angles,
    'domination': covariant_domination,
    'vectors': covariant_vectors,
}
POSITIVE, ALL = 37, 80  # of 20 disks
FORWARD = np.array([*np.linspace(9, 1, POSITIVE), *[0.0] * 6, *-np.linspace(1, 9, POSITIVE)])
UNSTABLE_STABLE, UNSTABLE_CENTRE, CENTRE_STABLE = range(3)
BINS = 90  # of the histograms of angles


def found_steps(info):
    return [
        made.step(info, T, 1, 0, 36, 37),
        made.step(info, LP, 1, 0, 32, 35),
        made.step(info, T, 1, 0, 44, 45, conjugate=True),
        made.zero_modes(38),
    ]


def covariant_angle(spaces, smallest, every, **fields):
    """Histograms from {bin: count}."""
    return made.message_of(
        CovariantAngle,
        fields,
        spaces=spaces,
        last=0.3,
        mean=0.329,
        std_error=0.006,
        least=0.21,
        mean_of_all=1.1,
        smallest_counts=[smallest.get(k, 0) for k in range(BINS)],
        all_counts=[every.get(k, 0) for k in range(BINS)],
    )


def angles():
    """Smallest ones: 30 in [0.1745, 0.1920) and 10 in the next bin; the centre is at right
    angles."""
    last = {BINS - 1: 40}
    return [
        covariant_angle(UNSTABLE_STABLE, {10: 30, 11: 10}, {20: 3000, 80: 1000}),
        covariant_angle(
            UNSTABLE_CENTRE, last, last, mean=np.pi / 2, least=np.pi / 2, std_error=2e-16
        ),
        covariant_angle(CENTRE_STABLE, last, last, mean=np.pi / 2, least=np.pi / 2, std_error=-1.0),
    ]


def backward():
    """The forward exponents and 0.03 more: 3 / sqrt(2) combined errors; one exponent 0.06 more,
    zero modes 0.1 less."""
    exponents = FORWARD + 0.03
    exponents[4] += 0.03
    exponents[POSITIVE : POSITIVE + 6] -= 0.13
    return exponents


def everything():
    """All 4N vectors, with every topic that is compared."""
    info, steps = made.run_info(exponents='all'), found_steps(made.run_info())
    message = made.covariant(
        backward(),
        angles=angles(),
        centre_start_mismatch=3e-12,
        stable_start_mismatch=5e-11,
        null_angle=4e-13,
        largest_null_angle=7e-13,
        weights=[
            made.covariant_weight(steps[0], ALL, 0.81, 0.27, gram_schmidt=0.93),
            made.covariant_weight(steps[1], ALL, 0.63, 0.19, gram_schmidt=0.55),
        ],
    )
    message.weights[0].dq[43:45] = [0.77] * 2  # of the conjugate step
    message.weights[0].gram_schmidt[43:45] = [0.73] * 2
    message.domination_violations[6] = message.violations[6] = message.domination_violations[
        36
    ] = 0.0
    message.start_mismatch[3], message.widths[2], message.cos_theta[2] = 1.0, 0.123, 0.456
    return [info, made.spectrum(FORWARD, 400.0), made.steps(steps), made.cost(500.0), message]


def line(axes, label):
    """Points of the line or the bars with that label."""
    for container in axes.containers:
        if container.get_label() == label:
            return container.lines[0].get_xydata()
    return next(one for one in axes.get_lines() if one.get_label() == label).get_xydata()


def at(points, x):
    return points[points[:, 0] == x, 1][0]


def dominated(violations):
    return dict(domination_violations=[violations] * (ALL - 1))


def inside_zeros():
    """Both ends of the zero exponents, 38 to 43, and all between them."""
    return dict(domination_violations=[0.5] * 36 + [0.0] * 7 + [0.5] * 36)


class Bags(bags.Figures):
    def changed(self, **fields):
        """A run of everything, with other fields of the covariant message."""
        messages = everything()
        for name, value in fields.items():
            setattr(messages[-1], name, value)
        return self.recorded(messages)

    def without(self, *kinds):
        return self.recorded([one for one in everything() if not isinstance(one, kinds)])

    def unknown_errors(self, *of):
        messages = everything()
        for which in of:
            messages[which].std_errors = [-1.0] * ALL
        return self.recorded(messages)

    def draw(self, kind, run=None):
        """The axes of one figure, of everything unless another run is given."""
        return kind.draw(self.changed() if run is None else run).axes


class Recorded(Bags):
    def test_last_of_the_run(self):
        """Since the averages were reset, if it is of a window."""
        info, spectra = made.run_info(), [made.spectrum(FORWARD, t) for t in (9.0, 1.0)]
        spectra[0].sim_time, spectra[1].sim_time = 340.0, 351.0
        first, last = made.covariant(FORWARD, windows=1), made.covariant(FORWARD, windows=2)
        last.sim_time = 360.0
        none = made.covariant(FORWARD, windows=0, averaged_time=0.0)
        other = made.covariant(FORWARD, run_id='other', windows=3)
        for windows, messages in (
            (2, [first, last, other]),
            (None, [none]),
            (None, [spectra[0], first, spectra[1]]),
            (2, [spectra[0], first, spectra[1], last]),
        ):
            found = self.recorded([info, *messages]).covariant
            self.assertEqual(found and found.windows, windows)


class Table(Bags):
    def lines(self, run=None):
        """{first words before two blanks: the rest of a line's words}"""
        text = report.report(run or self.changed())
        found = {}
        for one in text[text.index('covariant vectors:') :].splitlines():
            name, _, rest = one.strip().partition('  ')
            found.setdefault(name, []).append(rest.split())
        return found, text

    def test_lines(self):
        """Of everything they are in golden/steps.txt; here of few windows, where all pairs are
        dominated, and none, where starts have not met, and of no cost."""
        for fields, said in (
            (
                dict(windows=1, lost_windows=3),
                '1 window, 3 left out as covariant_memory was too small, 40 samples',
            ),
            (
                dominated(0.0),
                'dominated splittings (74): after the indices 1 2 3 4 5 6 7 8 and 66 more',
            ),
            (inside_zeros(), 'dominated splittings (2): after the indices 37 43\n'),
            (dominated(0.1), 'dominated splittings (0)\n'),
            (dict(centre_start_mismatch=0.3), ' rad: covariant_transient is too short'),
            (dict(stable_start_mismatch=0.3), ' rad: covariant_transient is too short'),
        ):
            self.assertIn(said, report.report(self.changed(**fields)))
        apart = dict(centre_start_mismatch=-1.0, stable_start_mismatch=-1.0)
        self.assertNotIn('spaces: ', report.report(self.changed(**apart)))
        self.assertIn(
            'covariant vectors took 12.5 s', report.report(self.without(Cost)).split('\n')
        )

    def test_errors(self):
        """0.03 over sqrt(0.03^2 + 0.04^2); unknown of one pass or of the other."""
        messages = everything()
        messages[1].std_errors, messages[-1].std_errors = [0.03] * ALL, [0.04] * ALL
        lines, _ = self.lines(self.recorded(messages))
        self.assertEqual(lines['T(1,0)'][0][-1], '+0.60')
        for which in (1, -1):
            lines, text = self.lines(self.unknown_errors(which))
            self.assertEqual(lines['T(1,0)'][0][-1], '-')
            self.assertNotIn('root mean square', text)

    def test_weights_of_a_wave_without_a_step(self):
        """The largest of as many vectors as there are dimensions: here in places that are apart."""
        weight = made.covariant_weight(made.step(made.run_info(), T, 0, 1, 30, 31), ALL, 0.4, 0.2)
        lines, _ = self.lines(self.changed(weights=[weight]))
        self.assertEqual(lines['T(0,1) *'][0], ['30-31', '0.900', '0.400', '0.200', '0.050'])
        weight.dq[10], weight.dp[10] = 0.6, 0.4
        weight.dq[50] = 0.9  # of the negative half
        lines, text = self.lines(self.changed(weights=[weight]))
        self.assertEqual(lines['T(0,1) *'][0], ['11', '..', '0.460', '0.500', '0.300', '0.050'])
        self.assertIn('* no step found', text)


class Figures(Bags):
    def test_exponents(self):
        axes = self.draw(covariant_exponents)  # whole, magnified; below them the deviations
        for label, wanted in (
            ('forward (Gram-Schmidt)', FORWARD),
            ('backward (covariant)', backward()),
            ('backward, between two samples', backward() + 0.1),
        ):
            points = line(axes[0], label)
            np.testing.assert_array_equal(points[:, 0], range(1, ALL + 1))
            np.testing.assert_allclose(points[:, 1], wanted)
            self.assertEqual(at(line(axes[1], label), 37), points[36, 1])
        off, zero = line(axes[2], 'difference'), line(axes[2], 'zero modes')
        self.assertAlmostEqual(at(off, 1), 3 / 2**0.5)
        self.assertAlmostEqual(at(off, 5), 6 / 2**0.5)
        self.assertEqual(list(zero[:, 0]), list(range(38, 44)))
        self.assertAlmostEqual(at(zero, 40), -10 / 2**0.5)
        self.assertEqual(len(off), 74)

    def test_points_are_below_the_legend(self):
        flat = made.covariant(FORWARD[:20] * 0.01 + 5)
        run = self.recorded([made.run_info(number=780), made.spectrum(FORWARD[:20], 400.0), flat])
        axes = self.draw(covariant_exponents, run)[0]
        axes.figure.canvas.draw()
        box = axes.get_legend().get_window_extent()
        for points in (axes.transData.transform(one.get_xydata()) for one in axes.get_lines()):
            self.assertFalse(any(box.contains(*point) for point in points))

    def test_error_bars(self):
        """Of each pass its own, where they are known."""
        messages = everything()
        messages[-1].std_errors = [-1.0] + [0.02] * (ALL - 1)
        axes = self.draw(covariant_exponents, self.recorded(messages))[0]
        drawn = [one for one in axes.containers if one.lines[2]]
        names = [one.get_label() for one in drawn]
        self.assertEqual(names, ['forward (Gram-Schmidt)', 'backward (covariant)'])
        ends = [[bar[:, 1] for bar in one.lines[2][0].get_segments() if len(bar)] for one in drawn]
        self.assertEqual([len(found) for found in ends], [ALL, ALL - 1])
        for found, error in zip(ends, (0.01, 0.02)):
            np.testing.assert_allclose(np.diff(found), 2 * error)

    def test_magnified_round_the_zero_modes(self):
        axes = self.draw(covariant_exponents)
        self.assertEqual([round(x, 1) for x in axes[3].get_xlim()], [21.2, 59.8])
        self.assertEqual(
            [text.get_text() for text in axes[1].texts], ['zero modes', 'T(1,0)', 'LP(1,0)']
        )

    def test_weights(self):
        first, second, *_ = self.draw(covariant_weights)
        self.assertEqual(
            [axes.texts[0].get_text() for axes in (first, second)], ['(a) T(1,0)', '(b) LP(1,0)']
        )
        for axes, dq, dp, members in (
            (first, 0.81, 0.27, (36, 37)),
            (second, 0.63, 0.19, (32, 33, 34, 35)),
        ):
            for index in members:
                self.assertAlmostEqual(at(line(axes, r'covariant, $\delta q$'), index), dq)
                self.assertAlmostEqual(at(line(axes, r'covariant, $\delta p$'), index), dp)
            self.assertAlmostEqual(at(line(axes, r'covariant, $\delta p$'), 30), 0.02)
        ours = line(first, r'Gram-Schmidt, $\delta q$')
        self.assertEqual([at(ours, index) for index in (35, 36, 37, 44)], [0.02, 0.93, 0.93, 0.73])
        self.assertEqual(line(first, 'by chance')[0, 1], 2 / 40)

    def test_angles_are_a_density(self):
        """Bins of pi / 180: 30 of 40 angles in one are 0.75 of the probability."""
        left, right = self.draw(covariant_angles)
        width = np.pi / 180
        for axes, shares in ((left, {10: 0.75, 11: 0.25}), (right, {20: 0.75, 80: 0.25})):
            points = line(axes, 'unstable-stable')
            np.testing.assert_allclose(points[:, 0], np.linspace(0, np.pi / 2, 91))
            for place, share in shares.items():
                self.assertAlmostEqual(points[place, 1], share / width)
            self.assertAlmostEqual(points[:, 1].sum() * width, 1)
        self.assertEqual((left.get_yscale(), right.get_yscale()), ('log', 'log'))
        np.testing.assert_allclose(left.get_xlim(), (9 * width, 13 * width))
        np.testing.assert_allclose(right.get_xlim(), (0, np.pi / 2))
        broad = covariant_angle(UNSTABLE_STABLE, {n: 1 for n in range(90)}, {n: 1 for n in (5, 6)})
        left, right = self.draw(covariant_angles, self.changed(angles=[broad]))
        np.testing.assert_allclose((*left.get_xlim(), left.get_ylim()[0]), (0, np.pi / 2, 0))

    def test_one_bin_is_said(self):
        right = ': at right angles, within 1°'
        for axes in self.draw(covariant_angles):
            self.assertEqual([len(one.get_xdata()) for one in axes.get_lines()], [91, 0, 0])
            said = [text.get_text() for text in axes.get_legend().get_texts()]
            names = ['unstable-stable', 'unstable-centre' + right, 'centre-stable' + right]
            self.assertEqual(said, names)
        one = covariant_angle(UNSTABLE_STABLE, {30: 5}, {30: 5})
        nearly = covariant_angle(UNSTABLE_STABLE, {30: 95, 31: 5}, {0: 5, 89: 95})
        for angle, said in (
            (one, ['30 .. 31°'] * 2),
            (nearly, ['95 % in 30 .. 31°', '95 % at right angles, within 1°']),
        ):
            panels = self.draw(covariant_angles, self.changed(angles=[angle]))
            labels = [axes.get_lines()[0].get_label() for axes in panels]
            self.assertEqual(labels, [f'unstable-stable: {words}' for words in said])

    def test_zero_modes_without_errors(self):
        """It is said why; not where they have errors."""
        known = [0.01] * POSITIVE
        run = self.changed(std_errors=[*known, *[-1.0] * 6, *known])
        self.assertIn(covariant_table.ZERO, report.report(run))
        self.assertNotIn(covariant_table.ZERO, report.report(self.changed()))

    def test_letters(self):
        for draw, letters in ((covariant_exponents, 'abcd'), (covariant_vectors, 'abcdefgh')):
            titles = [axes.get_title(loc='left') for axes in self.draw(draw)]
            self.assertEqual(titles, [f'({letter})' for letter in letters])

    def test_far_from_zero(self):
        """Of a few of the largest exponents nothing is magnified, and no weights are drawn."""
        info, count = made.run_info(number=780), 20
        wave = made.step(info, T, 1, 0, 1556, 1557)
        for largest, is_drawn in ((0.09, False), (0.11, True)):
            weight = made.covariant_weight(wave, 1557, elsewhere=0.01)
            weight.dq = [0.01] * (count - 1) + [largest]
            weight.dp, weight.gram_schmidt = weight.dp[:count], weight.gram_schmidt[:count]
            few = made.covariant(FORWARD[:count], weights=[weight])
            run = self.recorded([info, made.spectrum(FORWARD[:count], 400.0), few])
            self.assertEqual(len(self.draw(covariant_exponents, run)), 2)
            said = []
            page = FIGURES['weights'].draw(run, left_out=said)
            self.assertEqual((page is not None, len(said)), (is_drawn, not is_drawn))

    def test_domination(self):
        axes = self.draw(covariant_domination)
        points = line(axes[0], 'next vector grew more')
        self.assertEqual((points[0, 0], points[-1, 0]), (1.5, 79.5))
        self.assertEqual((at(points, 7.5), at(points, 8.5)), (0.0, 0.25))
        self.assertEqual(at(line(axes[2], 'of all times'), 8.5), 0.5)
        self.assertEqual(list(line(axes[2], 'never (2 dominated splittings)')[:, 0]), [7.5, 37.5])

    def test_domination_is_between_different_exponents(self):
        never = [37.5, 43.5]
        axes = self.draw(covariant_domination, self.changed(**inside_zeros()))
        self.assertEqual(list(line(axes[2], 'never (2 dominated splittings)')[:, 0]), never)
        times = [40.0, 80.0, 160.0]
        message = made.fluctuations([0.1] * ALL, times=times)
        for order in message.orders:
            order.domination_violations = inside_zeros()['domination_violations']
        drawn = self.draw(fluctuations, self.recorded([*everything()[:3], message]))
        for points in [one.get_xydata() for one in drawn[4].get_lines()]:
            self.assertEqual(list(points[points[:, 1] == 0, 0]), never)

    def test_vectors(self):
        axes = self.draw(covariant_vectors)[::2]
        self.assertEqual(at(line(axes[0], 'width'), 3), 0.123)
        self.assertEqual(at(line(axes[1], 'cosine'), 3), 0.456)
        self.assertEqual(at(line(axes[2], 'mean'), 1.5), 0.7)
        self.assertEqual(at(line(axes[2], 'smallest so far'), 1.5), 0.2)
        self.assertEqual(at(line(axes[3], 'apart'), 4), 1.0)
        self.assertEqual(at(line(axes[3], 'apart'), 5), 1e-9)


class Partly(Bags):
    """What may be missing or unknown."""

    def complete(self, run, *missing):
        """All figures but the missing ones, and the text."""
        text = report.report(run)
        drawn = {name: kind.draw(run) for name, kind in FIGURES.items()}
        for name, page in drawn.items():
            self.assertEqual(page is None, name in missing, name)
            if page is not None:
                bags.check_title(page.figure, name)
        return text

    def test_runs(self):
        none = covariant_angle(UNSTABLE_STABLE, {}, {})
        unknown = [-1.0] * ALL
        for run, missing in (
            (self.changed(windows=1, averaged_time=50.0, samples=1, std_errors=unknown), ()),
            (self.changed(angles=[none]), ()),
            (self.without(Steps), ()),
            (self.without(Spectrum), ()),
            (self.without(Steps, Spectrum, Cost), ()),
        ):
            self.complete(run, *missing)
        text = self.complete(self.changed(angles=[], weights=[]), 'angles', 'weights')
        self.assertIn('not all three are carried', text)

    def test_unknown_errors(self):
        run = self.unknown_errors(1, -1)
        self.complete(run)
        axes = self.draw(covariant_exponents, run)
        axes[0].figure.canvas.draw()
        self.assertEqual(len(axes), 2)  # without the row of differences
        left_out = FIGURES['exponents'].draw(run).left_out
        said = 'backward - forward in errors: errors are not known yet; average longer'
        self.assertEqual(left_out, [said])
        np.testing.assert_allclose(line(axes[0], 'backward (covariant)')[:, 1], backward())

    def test_a_part_of_the_vectors(self):
        """The positive half, and a few among which is no step; of one there are no neighbours."""
        info = made.run_info()
        found = found_steps(info)[:2]
        weights = [made.covariant_weight(found[0], POSITIVE)]
        half = made.covariant(backward()[:POSITIVE], weights=weights)
        of_half = [info, made.spectrum(FORWARD[:POSITIVE], 400.0), half, made.steps(found)]
        self.assertIn('T(1,0)', self.complete(self.recorded(of_half), 'angles'))
        for count, missing in ((1, ['domination']), (2, []), (5, [])):
            few = [made.spectrum(FORWARD[:count], 400.0), made.covariant(FORWARD[:count])]
            self.complete(self.recorded([info, *few]), 'angles', 'weights', *missing)

    def test_steps_that_share_a_set(self):
        """Both have rows of their own, over all vectors of the set."""
        info, messages = made.run_info(), everything()
        shared = [
            made.step(info, kind, 1, 0, 32, 37, set=7, members=2, expected=expected)
            for kind, expected in ((T, 2), (LP, 4))
        ]
        messages[2] = made.steps(shared)
        messages[-1].weights = [
            made.covariant_weight(step, ALL, dq) for step, dq in zip(shared, (0.4, 0.5))
        ]
        run = self.recorded(messages)
        rows = {
            step.kind: weights[1]
            for _, block in covariant.blocks(run)
            for step, weights in covariant.weights_over(run, block)
        }
        self.assertAlmostEqual(rows[T], 0.4)
        self.assertAlmostEqual(rows[LP], 0.5)
        self.complete(run)


class Command(Bags):
    def test_plot(self):
        """Without the topic it says nothing of it."""
        for messages, there in ((everything(), True), (everything()[:-1], False)):
            text = self.succeeds('plot', self.write(messages), '--out', self.out)
            self.assertEqual('covariant vectors: 200 time units in 4 windows' in text, there)
            self.assertEqual('covariant' in text, there)
            for name in bags.files(*('covariant_' + name for name in FIGURES)):
                self.assertEqual(name in text, there)
                self.assertIn(name, os.listdir(self.out))

    def test_on_paper(self):
        """Each can be drawn to the end."""
        run = self.changed()
        for name, kind in FIGURES.items():
            figure = kind.draw(run).figure
            figure.set_dpi(30)
            figure.canvas.draw()
            dark = np.asarray(figure.canvas.buffer_rgba())[..., :3] < 128
            self.assertTrue(dark.any(), name)
