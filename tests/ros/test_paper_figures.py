"""Figures for a journal: their widths, words and files; panels without data; what is assumed."""

import os
import unittest
from types import SimpleNamespace

import numpy as np
from matplotlib.figure import Figure

import bags

import made
import made_fields
import test_axes
from made import LP, T
from hdlyap.plots.figures import FIGURES, convergence, dispersion, fluctuations, modes, phases
from hdlyap.plots.figures import page, spectrum, steps, structure
from hdlyap.plots.figures.page import PAPER, TALLEST

INFO = made.run_info()
LOW, HIGH = made.step(INFO, T, 1, 0, 36, 37), made.step(INFO, LP, 1, 0, 32, 35)
HALF = np.linspace(9, 3, 37)


class Paper(bags.Figures):
    info = INFO

    def test_every_figure(self):
        """Of the width of the column, without a title, in its letters; with the same panels."""
        run = self.recorded(test_axes.everything())
        for name, figure in FIGURES.items():
            own = figure.draw(run)
            for paper, width in PAPER.items():
                page = figure.draw(run, paper=paper)
                self.assertEqual(page.figure.get_figwidth(), width, name)
                self.assertLessEqual(page.figure.get_figheight(), TALLEST, name)
                self.assertIsNone(page.figure._suptitle, name)
                self.assertIn('$N=20$', page.caption, name)
                self.assertEqual(len(page.axes), len(own.axes), name)
                fonts = {one.yaxis.label.get_fontfamily()[0] for one in page.axes}
                self.assertEqual(fonts, {'STIXGeneral'}, name)
                page.figure.canvas.draw()
        for column, places in (('one-column', 1), ('two-column', 2)):
            page = FIGURES['covariant_exponents'].draw(run, paper=column)
            left = {round(one.get_position().x0, 1) for one in page.axes}
            self.assertEqual(len(left), places)

    def test_names_are_inside(self):
        """In a narrow column, where the legend has room in the other panel."""
        pair = [made.step(INFO, *of, 28, 35) for of in ((T, 1, 1), (LP, 1, 0))]
        for step in pair:
            step.set, step.members = 7, 2
        info = made.run_info(number=40)
        run = self.load(
            made.steps([LOW, *pair]), made.spectrum(np.linspace(9, 3, 77), 50.0), info=info
        )
        page = spectrum.draw(run, paper='one-column')
        page.figure.canvas.draw()
        names = [(axes, text) for axes in page.axes for text in axes.texts]
        self.assertEqual({text.get_text() for _, text in names}, {'T(1,0)', 'LP(1,0)+T(1,1)'})
        for axes, text in names:
            self.assertLess(text.get_window_extent().y1, axes.bbox.y1)
        self.assertEqual([axes.get_legend() is None for axes in page.axes], [False, True])

    def test_titles_fit(self):
        """That of a narrow figure is broken; those of modes in a narrow column do not overlap."""
        info = made.run_info(scene='a scene whose name is rather long, longer than others')
        page = spectrum.draw(self.load(made.spectrum(HALF, 50.0), info=info))
        page.figure.canvas.draw()
        self.assertLess(page.figure._suptitle.get_window_extent().width, page.figure.bbox.width)
        fields = [made_fields.mode_field(INFO, step) for step in (LOW, HIGH)]
        run = self.load(made.steps([LOW, HIGH]), made.spectrum(HALF, 50.0, error=1e-4), *fields)
        page = modes.draw(run, paper='one-column')
        page.figure.canvas.draw()
        one, other = (axes._left_title.get_window_extent() for axes in page.axes)
        self.assertFalse(one.overlaps(other))

    def test_in_the_axes_of_the_user(self):
        """No title and no legend, if they are not wanted; the figure keeps its size."""
        run = self.load(made.steps([LOW, HIGH]), made.spectrum(HALF, 50.0))
        figure = Figure(figsize=(3, 2))
        axes = figure.subplots()
        dispersion.draw(run, ax=axes, title=False, legend=False)
        self.assertIsNone(axes.get_legend())
        self.assertEqual(list(figure.get_size_inches()), [3, 2])
        dispersion.draw(run, ax=axes)
        self.assertIsNotNone(axes.get_legend())
        page = dispersion.draw(run, title=False)
        self.assertIsNone(page.figure._suptitle)
        with self.assertRaisesRegex(ValueError, "paper: 'A4': must be one of one-column, two-c"):
            dispersion.draw(run, paper='A4')
        for wrong in (5, [None], [], figure):
            with self.assertRaisesRegex(ValueError, 'ax: .*: must be Axes of matplotlib, one or'):
                dispersion.draw(run, ax=wrong)

    def test_no_misfit(self):
        run = self.load(made.steps([LOW, HIGH]))
        for paper, said in ((None, ', misfit 1.2'), ('one-column', '')):
            labels = dispersion.draw(run, paper=paper).axes[0].get_legend_handles_labels()[1]
            self.assertIn('T: $c_{T}=1.400(12)$' + said, labels)

    def test_command(self):
        """Writes PDF files alone, and prints captions."""
        self.write(made.small_run())
        text = self.succeeds(
            'plot', self.path(), '--out', self.out, '--paper', 'one-column', '--only', 'dispersion'
        )
        self.assertEqual(os.listdir(self.out), ['dispersion.pdf'])
        caption = r'dispersion: made: $N=20$, $\rho=0.5$, $L_y/L_x=1$, periodic'
        self.assertIn(f'{caption}\n', text)

    def test_file(self):
        """Its letters are letters, which can be searched."""
        path = os.path.join(self.folder, 'a.pdf')
        page = dispersion.draw(self.load(made.steps([LOW, HIGH])), paper='one-column')
        page.save(path)
        with open(path, 'rb') as file:
            text = file.read()
        self.assertIn(b'/Subtype /Type0', text)
        self.assertNotIn(b'/Subtype /Image', text)
        self.assertIn(b'/MediaBox [ 0 0 243 ', text)  # 3.375 inch


class LeftOut(bags.Figures):
    """Panels without data, of which a line says why."""

    info = INFO

    def test_errors(self):
        run = self.load(*(made.spectrum(HALF, t, error=-1.0) for t in (1.0, 2.0)))
        page = convergence.draw(run)
        self.assertEqual(len(page.axes), 2)
        (line,) = page.left_out
        self.assertRegex(line, 'standard errors: none is known yet; average longer')
        axes = list(Figure().subplots(3))
        self.assertEqual(convergence.draw(run, ax=axes).left_out, [])
        self.assertEqual(axes[2].texts[0].get_text(), 'not yet known')

    def test_fluctuations(self):
        """Below 128 samples there is no diffusion; without fields no times, without steps no
        pairs."""
        pairs = [(LOW.kind, LOW.nx, LOW.ny, [36, 37])]
        known, unknown = list(np.linspace(0.5, 0.1, 37)), [np.nan] * 37
        for message, panels, said in (
            (made.fluctuations(known, pairs), 6, []),
            (made.fluctuations(unknown, pairs, error=-1.0), 3, ['diffusion: it takes 128']),
            (made.fluctuations(known), 5, ['correlations: no steps are resolved']),
            (made.fluctuations(known, times=()), 2, ['growth over finite times: a bag has it']),
        ):
            if panels == 3:
                message.covariances, message.variances = [np.nan], [0.1] * 74
                said = [*said, 'correlations: it takes 128']
            page = fluctuations.draw(self.load(message, made.steps([LOW])))
            self.assertEqual(sum(axes.axison for axes in page.axes), panels, said)
            self.assertEqual(len(page.left_out), len(said), page.left_out)
            for line, words in zip(page.left_out, said):
                self.assertTrue(line.startswith(words), line)
        page = fluctuations.draw(self.load(made.fluctuations(known, pairs), made.steps([LOW])))
        titles = [axes.get_title(loc='left') for axes in page.axes]
        self.assertEqual(titles, [f'({letter})' for letter in 'abcdef'])
        for axes in page.axes[3:5]:
            said = [text.get_text() for text in axes.get_legend().get_texts()]
            self.assertTrue(said[-1].endswith(' time units'), said)

    def test_command(self):
        """A figure that has nothing to show is said to be left out, too."""
        nothing = made.fluctuations([np.nan] * 37, error=-1.0, times=())
        self.write([INFO, *(made.spectrum(HALF, t, error=-1.0) for t in (1.0, 2.0)), nothing])
        text = self.succeeds('plot', self.path(), '--out', self.out)
        self.assertIn('\nconvergence does not show standard errors: none is known yet;', text)
        self.assertIn('\nfluctuations does not show diffusion: it takes 128', text)
        self.assertIn('\nfluctuations does not show growth over finite times: ', text)
        self.assertNotIn('fluctuations.png', os.listdir(self.out))

    def test_errors_of_fluctuations(self):
        """Of a variance over n times sqrt(2 / (n - 1)), of a fraction that of counts."""
        message = made.fluctuations(list(np.linspace(0.5, 0.1, 37)))
        page = fluctuations.draw(self.load(message))
        told = self.load(message).growth
        variance, order = page.axes[2:4]
        (bars,) = variance.containers[0].lines[2]
        count, value = told.times['count'][0], told.variances.iloc[0, 0]
        low, high = bars.get_segments()[0][:, 1]
        np.testing.assert_allclose((high - low) / 2, value * np.sqrt(2 / (count - 1)))
        (bars,) = order.containers[0].lines[2]
        p = told.violations.iloc[0, 0]
        low, high = bars.get_segments()[0][:, 1]
        np.testing.assert_allclose((high - low) / 2, np.sqrt(p * (1 - p) / count))


class Shown(bags.Figures):
    info = INFO

    def test_assumed_curvature(self):
        """Is dashed, and said to be assumed; in the table, too."""
        for share, style, said in ((0.25, '-', False), (1.0, '--', True)):
            message = made.steps([LOW])
            message.t_points, message.t_prior_share, message.l_points = 1, share, 0
            axes, _ = self.draw(dispersion, message)
            curve = next(line for line in axes.lines if len(line.get_xdata()) == 100)
            self.assertEqual(curve.get_linestyle(), style)
            self.assertEqual(curve.get_label().endswith(', curvature assumed'), said)

    def test_the_later_course_sets_the_scale(self):
        """From 4.5 to 5.1 of the first tenth, then near 3."""
        spectra = [made.spectrum(HALF / 3 + (2 if t < 5 else 0.01 * t), t) for t in range(1, 51)]
        top = self.draw(convergence, *spectra)[0]
        low, high = top.get_ylim()
        self.assertTrue(2.9 < low < 3.04 and 3.5 < high < 3.6, (low, high))

    def test_errors_have_an_axis_of_their_own(self):
        early = [made.spectrum(HALF, t, error=-1.0) for t in range(1, 40)]
        late = [made.spectrum(HALF, t, error=0.1) for t in range(40, 51)]
        top, middle, bottom = self.draw(convergence, *early, *late)
        self.assertEqual(top.get_xlim(), middle.get_xlim())
        self.assertGreater(bottom.get_xlim()[0], 30)

    def test_labels_of_short_courses(self):
        """Those of a log axis shorter than a decade do not overlap."""
        late = [made.spectrum(HALF, t, error=0.1 / t) for t in range(160, 200)]
        for axes in self.draw(convergence, *late)[2:]:
            boxes = [one.get_window_extent() for one in axes.get_xticklabels() if one.get_text()]
            shown = [
                box for box in boxes if axes.bbox.x0 <= 0.5 * (box.x0 + box.x1) <= axes.bbox.x1
            ]
            self.assertGreater(len(shown), 1)
            for one, other in zip(shown, shown[1:]):
                self.assertLess(one.x1, other.x0)

    def test_phases_that_were_found_again(self):
        """Go on where they were, but for less than half a turn."""
        time = np.arange(10.0)
        whole = 1.5 * time, 1.5 * (time + 10)
        curves = [(time, whole[0]), (time + 10, whole[1] - 4 * 2 * np.pi + 0.3)]
        found = list(phases.joined(curves))
        np.testing.assert_allclose(found[0][1], whole[0])
        np.testing.assert_allclose(found[1][1], whole[1] + 0.3)
        later = [(time, whole[0] - 30), (time + 10, whole[1])]  # the longest begins late
        np.testing.assert_allclose(next(phases.joined(later))[1], whole[0] - 30 + 4 * 2 * np.pi)
        self.assertEqual(list(phases.joined([])), [])

    def test_few_phases_are_points(self):
        for count, marker in ((4, '.'), (40, '')):
            told = [made.lp_phases(INFO, [HIGH], 101.0 + t, began=100.0) for t in range(count)]
            top, _ = self.draw(phases, made.steps([HIGH]), *told)
            self.assertEqual(top.lines[0].get_marker(), marker)

    def test_short_pieces_of_a_long_course_are_lines(self):
        told = [made.lp_phases(INFO, [HIGH], 101.0 + t, began=100.0) for t in range(60)]
        for one in told[30:]:
            for phase in one.phases:
                phase.tracked_time = one.sample_time - 130.5
        top, _ = self.draw(phases, made.steps([HIGH]), *told)
        self.assertEqual({line.get_marker() for line in top.lines[:-1]}, {''})

    def test_long_titles_of_panels_are_broken(self):
        """At commas, without a second one."""
        names = [f'T({n},0)' for n in range(1, 9)]
        for wanted in (names[:1], names):
            axes = page.Page().sheet(4.6, 3).subplots()
            text = axes.set_title(', '.join([steps.APART, *wanted]), loc='left')
            page.fit(text)
            box = text.get_window_extent(axes.figure.canvas.get_renderer())
            self.assertLess(box.x1, 460)
            self.assertEqual(text.get_text().replace('\n', ' '), ', '.join([steps.APART, *wanted]))

    def test_long_titles_of_figures_make_room(self):
        """The panels keep their heights."""
        heights = []
        for scene in 'a', 'a, ' * 40:
            sheet = page.Page()
            sheet.panels(1, 1, 4.2, 2)
            sheet.title(made.run_info(scene=scene))
            lines = sheet.figure._suptitle.get_text().count('\n')
            heights.append((lines > 0, sheet.figure.get_figheight() - lines * page.LINE))
        self.assertEqual([is_broken for is_broken, _ in heights], [False, True])
        np.testing.assert_allclose([height for _, height in heights], 2)

    def test_rows_of_k_without_waves(self):
        means = SimpleNamespace(
            wave_number=np.array([1.0, 2.0]), along=np.array([[0.5, 0], [0, 0]])
        )
        image = structure._ridge(page.Page().sheet(3, 3).subplots(), means, 'along', {})
        np.testing.assert_array_equal(np.ma.getmaskarray(image.get_array()).ravel()[-2:], True)
        np.testing.assert_array_equal(np.ma.getmaskarray(image.get_array()).ravel()[:2], False)

    def test_far_exponents_have_a_scale_of_their_own(self):
        for exponents, has_zero in ((np.linspace(7, 6, 20), False), (HALF, True)):
            axes = self.draw(spectrum, made.spectrum(exponents, 50.0))[0]
            self.assertEqual(axes.get_ylim()[0] <= 0, has_zero)

    def test_exponents_of_a_step_that_are_apart(self):
        """By more than errors of which each is known from some blocks alone."""
        for off, error, said in ((0.01, 0.001, True), (0.01, 0.01, False), (0.01, -1.0, False)):
            exponents = np.linspace(9, 3, 37)
            exponents[31:35] = 2 * (1 + off * np.array([1, 0.3, -0.3, -1]))
            message = made.spectrum(exponents, 50.0, error=error)
            _, bottom = self.draw(steps, message, made.steps([HIGH]))
            title = bottom.get_title(loc='left')
            self.assertEqual(title == f'(b) {steps.APART}: LP(1,0)', said, title)


if __name__ == '__main__':
    unittest.main()
