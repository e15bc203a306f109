"""The figures of hdlyap plot: what each of them shows is what was recorded, read back from what
matplotlib has of it."""


import numpy as np

import bags
import made
import made_fields
from made import LP, T
from hdlyap.data import waves
from hdlyap.plots import report
from hdlyap.plots.figures import (
    box,
    convergence,
    cost,
    dispersion,
    localization,
    modes,
    p_mode,
    page,
    phases,
    spectrum,
    steps,
)
from hdlyap.plots.figures.style import INK, KIND_COLOURS, scene

INFO = made.run_info()
LOW, HIGH = made.step(INFO, T, 1, 0, 36, 37), made.step(INFO, LP, 1, 0, 32, 35)
EXPONENTS = np.linspace(9, 3, 37)
ERRORS = np.linspace(0.01, 0.37, 37)


def bars(container):
    """Lower and upper ends of error bars."""
    return np.array([one[:, 1] for one in container.lines[2][0].get_segments()]).T


class Figures(bags.Figures):
    info = INFO

    def shows(self, line, x, y):
        np.testing.assert_allclose(line.get_xydata(), np.transpose([x, y]), rtol=1e-9)

    def test_convergence(self):
        """Means and errors at averaged times; the course of all errors, and 1 / sqrt(t)."""
        times = np.arange(1.0, 5.0)
        messages = [made.spectrum(EXPONENTS + t, t, error=0.1 / t) for t in times]
        for one, t in zip(messages, times):
            one.std_errors[0], one.std_errors[36] = 0.05 / t, 0.07 / t
        top, middle, bottom = self.draw(convergence, *messages)
        self.shows(top.lines[0], times, 9 + times)
        last = [(index, EXPONENTS[index - 1]) for index in (34, 35, 36, 37)]
        for line, (index, exponent) in zip(middle.lines, last):
            self.assertEqual(line.get_label(), rf'$\ell={index}$')
            self.shows(line, times, exponent + times)
        for axes, number, mean, error in ((top, 0, 9, 0.05), (middle, 3, 3, 0.07)):
            (corners,) = (path.vertices for path in axes.collections[number].get_paths())
            for t in times:
                at = corners[corners[:, 0] == t, 1]
                ends = mean + t - error / t, mean + t + error / t
                np.testing.assert_allclose((at.min(), at.max()), ends)
        typical = np.sqrt((35 * 0.1**2 + 0.05**2 + 0.07**2) / 37)
        self.shows(bottom.lines[0], times, typical / times)
        self.shows(bottom.lines[1], times, typical / 4 * np.sqrt(4 / times))

    def test_mirrored(self):
        """Where exponents are not in pairs: all of them with the other sign, the last one first."""
        found = np.linspace(9, -9.5, 80)
        for divergence, count in ((-20.0, 1), (np.nan, 0)):
            whole, _ = self.draw(spectrum, made.spectrum(found, 50.0, divergence=divergence))
            mirrored = [one for one in whole.lines if one.get_label().startswith(r'$-\lambda')]
            self.assertEqual(len(mirrored), count)
            if mirrored:
                self.shows(mirrored[0], np.arange(1, 81), -found[::-1])
                of_all = made.spectrum(found, 50.0, divergence=divergence), made.steps([LOW])
                page = spectrum.draw(self.recorded([INFO, *of_all]), paper='one-column')
                (said, *_) = page.axes[0].get_legend().get_texts()
                self.assertEqual(said.get_text(), mirrored[0].get_label())

    def test_spectrum(self):
        """At their indices, with errors, in the colours of the steps; with the paper's bands."""
        message = made.spectrum(EXPONENTS, 50.0)
        message.std_errors = ERRORS
        (small,) = self.draw(spectrum, message, made.steps([LOW, HIGH]))
        self.assertEqual(len(small.containers), 37)
        for index, one in enumerate(small.containers, 1):
            value, error = EXPONENTS[index - 1], ERRORS[index - 1]
            self.shows(one.lines[0], [index], [value])
            np.testing.assert_allclose(bars(one).ravel(), [value - error, value + error])
            colour = INK if index < 32 else KIND_COLOURS['LP' if index < 36 else 'T']
            self.assertEqual(one.lines[0].get_color(), colour, index)
        names = [(text.get_text(), text.xy[0]) for text in small.texts]
        self.assertEqual(names, [('LP(1,0)', 33.5), ('T(1,0)', 36.5)])
        said = [text.get_text() for text in small.get_legend().get_texts()]
        self.assertEqual(said[-1], 'of no step')
        info = made.paper_info()
        values = np.linspace(6.8, 0.7, 1557)
        whole, small = self.draw(spectrum, made.spectrum(values, 10.0), info=info)
        self.shows(whole.containers[0].lines[0], range(1, 1558), values)
        self.assertEqual(
            [one.lines[0].get_xdata()[0] for one in small.containers][::39], [1518, 1557]
        )
        band = small.collections[-1].get_paths()[0].vertices
        names = {text.get_text(): text.xy[1] for text in small.texts}
        self.assertAlmostEqual(names['T(1,0)'], 0.6155, places=4)
        np.testing.assert_allclose(band[:, 1].min() / band[:, 1].max(), 0.97 / 1.03)

    def test_indices_that_are_not_drawn(self):
        far = made.step(INFO, T, 1, 0, 30, 80)
        run = self.recorded([INFO, made.spectrum(EXPONENTS, 50.0), made.steps([far])])
        self.assertEqual(list(spectrum._colours(run, 20, 37)), list(range(30, 38)))

    def test_cost(self):
        """Seconds by part, above one another in (a); of made.cost 10, 20, 55 and 5 %."""
        # of each stage the first
        stages = [
            made.status(time, stage=stage) for time, stage in zip((20, 30, 40, 50), (1, 1, 2, 2))
        ]
        course, share = self.draw(cost, *stages, *map(made.cost, (50.0, 100.0)))
        # at the end the rest: of before the first report, and after it
        parts = [10, 20, 55, 0, 5, 0, 0, 0, 5, 5]
        tops = [path.vertices for one in course.collections for path in one.get_paths()]
        halfway = [5, 10, 27.5, 0, 2.5, 0, 0, 0, 0, 5]
        for time, spent in ((50.0, halfway), (100.0, parts)):
            for corners, top in zip(tops, np.cumsum(spent)):
                self.assertAlmostEqual(max(corners[corners[:, 0] == time, 1]), top)
        shown = [part for part in parts if part]  # what took no time is left out
        np.testing.assert_allclose([bar.get_width() for bar in share.patches], shown, atol=1e-9)
        said = [text.get_text() for text in share.texts]
        self.assertEqual((said[2], said[3]), ('55 s (55.0 %)', '5 s (5.0 %)'))
        labels = [text.get_text() for text in share.get_yticklabels()]
        self.assertEqual((labels[2], labels[3]), ('orthonormalisation', 'classification'))
        began = {text.get_text(): text.xy[0] for text in course.texts}
        self.assertEqual(began, {'warming up': 20.0, 'averaging': 40.0})

    def test_cost_of_a_run_that_goes_on(self):
        """What the node counts from 0 again is added; the wall clock goes on by itself."""
        messages = [made.cost(time) for time in (50.0, 60.0, 70.0, 80.0)]
        for one, seconds in zip(messages, (3.0, 4.0, 1.0, 2.0)):
            one.publish_seconds = seconds
        found = self.recorded([INFO, *messages]).cost()
        np.testing.assert_array_equal(found['publish'], [3, 4, 5, 6])
        np.testing.assert_array_equal(found['wall'], [50, 60, 70, 80])

    def test_dispersion(self):
        """Points with errors over k, the fits through them, and the waves' nodes along the top."""
        other = made.step(INFO, T, 1, 1, 24, 27)
        axes, upper = self.draw(
            dispersion, made.spectrum(EXPONENTS, 50.0), made.steps([LOW, HIGH, other])
        )
        self.assertEqual(len(axes.containers), 3)
        for one, step, colour in zip(axes.containers, (LOW, HIGH, other), ('T', 'LP', 'T')):
            self.shows(one.lines[0], [step.wave_number], [step.exponent])
            ends = step.exponent + np.array([-made.ERROR, made.ERROR])
            np.testing.assert_allclose(bars(one).ravel(), ends)
            self.assertEqual(one.lines[0].get_color(), KIND_COLOURS[colour])
        curves = [line for line in axes.lines if len(line.get_xdata()) == 100]
        for line, name, c in zip(curves, ('LP', 'T'), ((1.5, 0.5, 0.7), (1.4, 0.1, 0.2))):
            k = line.get_xdata()
            self.shows(line, k, c[0] * k + c[1] * k**2 + c[2] * k**3)
            self.assertEqual(line.get_color(), KIND_COLOURS[name])
        labels = [line.get_label() for line in curves]
        self.assertEqual(labels, ['LP: $c_{L}=1.500(20)$', 'T: $c_{T}=1.400(12)$, misfit 1.2'])
        np.testing.assert_allclose(upper.get_xticks(), [made.K, 2**0.5 * made.K])
        self.assertEqual(upper.get_xlim(), axes.get_xlim())
        self.assertEqual([one.get_text() for one in upper.get_xticklabels()], ['(1,0)', '(1,1)'])
        info = made.run_info(number=400, density=0.4)  # the paper has curves of it
        axes, _ = self.draw(dispersion, made.steps([LOW]), info=info)
        published = [line for line in axes.lines if line.get_label() == '_published']
        for line, c, c2 in zip(published, (1.422, 1.412), (0.55, 0.086)):
            k = line.get_xdata()
            self.shows(line, k, c * k + c2 * k**2)
        self.assertEqual(len(published), 2)

    def test_dispersion_of_a_circle(self):
        """Its LP steps are points alone, and it is said why."""
        round_steps = made.steps([LOW, HIGH])
        round_steps.l_points, round_steps.l_long_c2 = 0, np.nan
        axes, _ = self.draw(dispersion, round_steps, info=made.run_info(number=400, density=0.4))
        self.assertEqual(len(axes.containers), 2)
        self.assertEqual([len(line.get_xdata()) for line in axes.lines].count(100), 2)  # T
        labels = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertIn('LP steps, which follow no relation', labels)
        self.assertIn('T steps', labels)

    def test_steps(self):
        """What was found in % of what is expected, and each exponent from their mean in %."""
        shared = dict(set=7, members=2, expected=4)
        both = [
            made.step(INFO, T, 1, 1, 26, 33, multiplicity=3.9, **shared),
            made.step(INFO, LP, 0, 1, 26, 33, multiplicity=3.5, **shared),
        ]
        exponents = EXPONENTS.copy()
        exponents[35:] = 1.01, 0.99
        top, bottom = self.draw(steps, made.spectrum(exponents, 50.0), made.steps([LOW, *both]))
        names = [text.get_text() for text in bottom.get_xticklabels()]
        self.assertEqual(names, ['T(1,0)', 'LP(0,1)\n+T(1,1)'])
        np.testing.assert_allclose([bar.get_height() for bar in top.patches], [99.0, 92.5])
        self.assertEqual([text.get_text() for text in top.texts], ['2.0/2', '7.4/8'])
        self.assertEqual(top.lines[1].get_ydata()[0], 50.0)  # the threshold
        off = bottom.containers[0]
        np.testing.assert_allclose(off.lines[0].get_ydata(), [1.0, -1.0])
        np.testing.assert_allclose(bars(off), [[0.0, -2.0], [2.0, 0.0]], atol=1e-9)

    def test_modes(self):
        """Arrows at the disks, as long as the field but for one factor; the last of each step."""
        fields = [
            made_fields.mode_field(INFO, LOW, 149.0, index=37),
            made_fields.mode_field(INFO, LOW, 150.0, index=36),
            made_fields.mode_field(INFO, HIGH, 150.0, index=35),
            made_fields.mode_field(INFO, HIGH, 90.0, index=12),
        ]
        run = self.recorded([INFO, made.steps([HIGH, LOW]), *fields])
        panels = [(panel.name, panel.field.index) for panel in modes.chosen(run)]
        self.assertEqual(panels, [('T(1,0)', 36), ('LP(1,0)', 35)])
        run.info.field_indices = '36 35 12'
        names = [panel.name for panel in modes.chosen(run)]
        self.assertEqual(names, ['T(1,0)', 'LP(1,0)', 'no step'])
        for axes, field, said in zip(
            self.draw(modes, made.steps([HIGH, LOW]), *fields),
            fields[1:],
            (
                rf'(a) T(1,0), $\ell=36$, $\lambda={LOW.exponent:.4f}$',
                rf'(b) LP(1,0), L part (100 %), $\ell=35$, $\lambda={HIGH.exponent:.4f}$',
            ),
        ):
            disks, arrows = axes.collections
            np.testing.assert_allclose(disks.get_offsets(), np.transpose([field.x, field.y]))
            np.testing.assert_allclose(arrows.XY, np.transpose([field.x, field.y]))
            drawn, dq = np.array([arrows.U, arrows.V]), np.array([field.dqx, field.dqy])
            np.testing.assert_allclose(drawn, dq * 1.3 * np.sqrt(20 / np.sum(dq**2)))
            self.assertEqual(axes.get_title(loc='left'), said)

    def test_l_part(self):
        """Of 0.6 l + 0.8 n, with l in the L modes and n beside them, 0.6 l; the exponent has the
        error of its index."""
        field = made_fields.mode_field(INFO, HIGH, 150.0, index=35)
        one, other, beside = np.linalg.qr(np.random.default_rng(3).normal(size=(40, 3)))[0].T
        field.l_x, field.l_y = np.concatenate([one.reshape(2, 20), other.reshape(2, 20)], axis=1)
        dq = 0.3 * one + 0.4 * other + 0.5 * beside
        field.dqx, field.dqy = dq.reshape(2, 20)
        part, share = modes.l_part(field)
        np.testing.assert_allclose(part.ravel(), 0.3 * one + 0.4 * other, atol=1e-12)
        self.assertAlmostEqual(share, 0.5)
        spectrum_of = made.spectrum(EXPONENTS, 50.0, error=0.0012)
        (axes,) = self.draw(modes, made.steps([HIGH]), spectrum_of, field)
        said = f'LP(1,0), L part (50 %), $\\ell=35$, $\\lambda={HIGH.exponent:.4f}(12)$'
        self.assertEqual(axes.get_title(loc='left'), said)
        arrows = np.array([axes.collections[1].U, axes.collections[1].V])
        self.assertAlmostEqual(np.sqrt(np.mean(np.sum(arrows**2, axis=0))), 1.3)
        np.testing.assert_allclose(arrows / arrows[0, 0], part / part[0, 0])

    def test_names_of_small_steps(self):
        """Those of a vector each do not overlap: one is above the other."""
        found = [made.step(INFO, T, n, 0, 38 - n, 38 - n) for n in (1, 2)]
        (axes,) = self.draw(spectrum, made.spectrum(EXPONENTS, 50.0), made.steps(found))
        boxes = [text.get_window_extent() for text in axes.texts]
        self.assertEqual(len(boxes), 2)
        self.assertFalse(boxes[0].overlaps(boxes[1]))

    def test_places_of_modes(self):
        """Two square boxes are beside each other, six wide ones below each other."""
        for count, edges, columns in ((2, (12, 12), 2), (6, (40, 4), 1), (6, (35, 35), 2)):
            info = made.run_info(box_x=edges[0], box_y=edges[1])
            self.assertEqual(modes._columns(count, info), columns)

    def test_names_hide_the_line_of_zero(self):
        """Above it, and below points."""
        (axes,) = self.draw(spectrum, made.spectrum(EXPONENTS, 50.0), made.steps([LOW]))
        (line,) = [one for one in axes.lines if list(one.get_ydata()) == [0, 0]]
        points = min(one.lines[0].get_zorder() for one in axes.containers)
        (name,) = axes.texts
        self.assertTrue(line.get_zorder() < name.get_zorder() < points)
        self.assertEqual(name.get_bbox_patch().get_facecolor(), (1, 1, 1, 1))

    def test_modes_of_a_channel(self):
        """Both components along it, with a mean square of one."""
        info = made.run_info(aspect=0.0375, box_x=40.0, box_y=1.5, boundary_y='reflecting')
        step = made.step(info, LP, 1, 0, 35, 38)
        field = made_fields.mode_field(info, step)
        (axes,) = self.draw(modes, made.steps([step]), field, info=info)
        factor = np.sqrt(20 / np.sum(np.square([field.dqx, field.dqy])))
        self.shows(axes.lines[0], field.x, np.multiply(field.dqx, factor))
        self.shows(axes.lines[1], field.x, np.multiply(field.dqy, factor))
        part, _ = modes.l_part(field)
        order = np.argsort(field.x)
        self.shows(axes.lines[2], np.array(field.x)[order], factor * part[0][order])

    def test_p_mode(self):
        """Is what the field says; above its values, below their quotients, beside the fit."""
        along = made.step(INFO, LP, 0, 1, 28, 31)
        diagonal = made.step(INFO, LP, 1, 1, 30, 37, exponent=1.0)
        last = made_fields.mode_field(INFO, along, modulations=(0, 2))
        last.residual_p = [0.2, 0.1]
        fields = [made_fields.mode_field(INFO, diagonal, modulations=(0, 1, 2, 3)), last]
        run = self.recorded([INFO, made.steps([diagonal, along]), *fields])
        field = p_mode.chosen(run)
        self.assertEqual((field.nx, field.ny, field.pairs), (0, 1, 2))
        mode = p_mode.PMode(field, 1, INFO)
        self.assertEqual((mode.along, mode.formula), ('y', r'$\sin k_y y$'))
        a = np.sin(2 * np.pi * np.array(field.y) / INFO.box_y)
        for part in mode.divided:
            self.assertGreater(np.corrcoef(part, a)[0, 1], 0.9)
        axes = self.draw(p_mode, made.steps([diagonal, along]), *fields)
        raw = np.array([field.p_x[20:], field.p_y[20:]])
        for column in range(2):
            self.shows(axes[column].lines[1], field.y, raw[column] / np.sqrt(np.mean(raw**2)))
            part = (field.p_over_px, field.p_over_py)[column][20:]
            self.shows(axes[2 + column].lines[1], field.y, part)
            place = axes[2 + column].lines[2].get_xdata()
            wave = mode.amplitude(column) * np.sin(2 * np.pi * place / INFO.box_y)
            self.shows(axes[2 + column].lines[2], place, wave)
            self.assertAlmostEqual(mode.amplitude(column), 1.0, delta=0.3)
        dots = self.draw(p_mode, made.steps([diagonal]), fields[0])[0].collections[0]
        clear = abs(dots.get_array()) > 0.1
        red, _, blue, _ = dots.get_facecolors()[clear].T
        np.testing.assert_array_equal(red > blue, dots.get_array()[clear] > 0)

    def test_phases(self):
        """In turns, and in % of a turn from the straight line; v beside the name."""
        told = [made.lp_phases(INFO, [HIGH], float(t), began=100.0) for t in range(101, 106)]
        for one in told:
            one.phases[0].phase += 0.1 * (one.sim_time == 103)
        top, bottom = self.draw(phases, made.steps([HIGH]), *told)
        times = np.arange(101.0, 106.0)
        bump = 0.1 * (times == 103)
        turned = bump - made.VELOCITY * made.K * (times - 100)  # of vector 32
        self.shows(top.lines[0], times, turned / (2 * np.pi))
        np.testing.assert_allclose(
            bottom.lines[0].get_ydata(), 100 * (bump - 0.02) / (2 * np.pi), atol=1e-9
        )
        self.assertEqual(top.lines[-1].get_label(), 'LP(1,0): $v = 1.600(16)$')

    def test_localization(self):
        """Widths with errors; of many vectors the largest exponents once more, beside covariant."""
        widths = np.linspace(0.1, 0.8, 37)
        (axes,) = self.draw(localization, made.localization(widths))
        self.shows(axes.containers[0].lines[0], np.arange(1, 38), widths)
        np.testing.assert_allclose(bars(axes.containers[0]), [widths - 0.01, widths + 0.01])
        self.assertEqual(axes.lines[-1].get_ydata()[0], 1 / 20)  # one disk
        many = list(np.linspace(0.1, 0.8, 80))
        info = made.run_info(number=43)
        whole, part = self.draw(
            localization, made.localization(many), made.covariant(many), info=info
        )
        self.shows(whole.containers[1].lines[0], np.arange(1, 81), [0.4] * 80)
        self.shows(part.containers[0].lines[0], np.arange(1, 49), many[:48])
        shown = [len(one.lines[0].get_xdata()) for one in part.containers]
        self.assertEqual(shown, [localization.LARGEST] * 2)
        self.assertEqual(len(part.get_legend().get_texts()), 2)

    def test_title(self):
        """A name of a scene may look like a formula."""
        info = made.run_info(scene=r'a $\frac{ b $ $')
        self.draw(spectrum, made.spectrum(EXPONENTS, 50.0), info=info)
        self.assertEqual(scene(INFO), r'made: $N=20$, $\rho=0.5$, $L_y/L_x=1$, periodic')
        walls = made.run_info(boundary_y='reflecting')
        self.assertIn('$, x periodic, y reflecting', scene(walls))

    def test_curved_container(self):
        """Is named with its size and drawn by its outline, without a frame; waves of a circle have
        (m,n) and no direction."""
        circle = made.run_info(container='circle', boundary_x='curved', boundary_y='curved')
        circle.box_x = circle.box_y = 17.06
        self.assertEqual(scene(circle), r'made: $N=20$, $\rho=0.5$, circle, $R=8.53$')
        self.assertEqual(
            report.system(circle), 'N = 20, density 0.5, packing 0.3927, circle, R = 8.5300'
        )
        corners = [(8.0, 3.0), (4.0, 6.0), (0.0, 3.0), (4.0, 0.0)]
        x, y = zip(*corners)
        info = made.run_info(
            **dict(container='lens', box_x=8.0, box_y=6.0, outline_x=x, outline_y=y),
            **dict(boundary_x='curved', boundary_y='curved', wave_nx=[1], wave_ny=[1]),
        )
        self.assertEqual(scene(info), r'made: $N=20$, $\rho=0.5$, lens, $8\times6$')
        self.assertEqual(
            report.system(info), 'N = 20, density 0.5, packing 0.3927, lens, 8.000 x 6.000'
        )
        axes = page.Page().panels(1, 1, 3, 3)
        box.Particles(axes, info, np.array([[4.0], [4.0]]), which=[0])
        (wall,) = axes.patches
        np.testing.assert_array_equal(wall.get_xy(), [*corners, corners[0]])
        self.assertFalse(any(spine.get_visible() for spine in axes.spines.values()))
        self.assertEqual(waves.formula(2, 1, waves.COS_M), r'$J_{2}(k r)\,\cos 2\theta$')
        self.assertEqual(waves.formula(2, 1, waves.SIN_M), r'$J_{2}(k r)\,\sin 2\theta$')
