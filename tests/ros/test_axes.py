"""Every figure in axes of the user's; no backend but the one that the user has chosen."""

import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgba_array

import bags
import made
import made_fields
import test_covariant_pictures
import test_strangers
import test_structure
from hdlyap.plots.figures import FIGURES
from hdlyap.sweep import figure as sweep, points

PANELS = {'dispersion': 1, 'convergence': 3, 'structure': 3, 'p_mode': 4}
PANELS.update(fluctuations=6)
PANELS.update(covariant_exponents=4, covariant_domination=4, covariant_vectors=8)
MAPS = 'structure'  # of which the look is not a colour


def everything():
    """A message of every topic that is drawn."""
    info, *rest = test_covariant_pictures.everything()
    t, lp, *others = found = test_covariant_pictures.found_steps(info)
    field = made_fields.mode_field(info, lp, 150.0, index=35, modulations=(0, 1))
    field.residual_p = [0.2, 0.1]
    times = np.arange(101.0, 140.0)
    messages = [
        *(info, *rest, made.steps([lp, t, *others]), field),
        made_fields.mode_field(info, t, 150.0, index=36),
        *(made.lp_phases(info, [lp], time, began=100.0) for time in times),
        *(test_structure.message(info, time, found[:2], vectors=80) for time in times),
        made.localization(list(np.linspace(0.1, 0.8, 80))),
        made.fluctuations(
            list(np.linspace(0.5, 0.01, 80)),
            [(one.kind, one.nx, one.ny, [one.first_index, one.last_index]) for one in (lp, t)],
        ),
    ]
    return messages + made.others(test_strangers.every_kind(), info)


class Axes(bags.Bags):
    def setUp(self):
        super().setUp()
        self.addCleanup(plt.close, 'all')

    def users(self, count):
        figure, grid = plt.subplots(1, count, squeeze=False, dpi=30)
        return figure, grid[0]

    def check(self, draw, count, name, colour='#123456'):
        """Into the user's axes and nowhere else, in the user's colour."""
        figure, axes = self.users(count)
        before, open_ones = set(figure.get_children()), plt.get_fignums()
        look = {'alpha': 0.43} if name in MAPS else {'color': colour}
        page = draw(ax=axes, **look)
        self.assertEqual((page.figure, list(page.axes)), (figure, list(axes)), name)
        self.assertIsNone(figure._suptitle, name)
        self.assertEqual(plt.get_fignums(), open_ones, name)
        more = {type(one).__name__ for one in set(figure.get_children()) - before}
        self.assertLessEqual(more, {'Axes', 'AxesSubplot'}, name)  # twins, bars of colours
        for one in page.axes:
            drawn = [artist for artist in page.artists if artist.axes is one]
            self.assertTrue(drawn, name)
            self.assertTrue(one.get_xlabel() or name == 'steps', name)
            self.assertFalse(one.get_title(loc='left').startswith('('), name)
            shown = [artist.get_alpha() == 0.43 or is_of(artist, colour) for artist in drawn]
            self.assertTrue(any(shown) or name == 'structure' and one is axes[2], name)
        figure.canvas.draw()
        with self.assertRaisesRegex(ValueError, f'ax: {count + 1} axes, for {count} panels'):
            draw(ax=self.users(count + 1)[1])
        own = draw()
        self.assertNotIn(own.figure, map(plt.figure, plt.get_fignums()), name)
        self.assertGreaterEqual(len(own.axes), count, name)
        plt.close('all')

    def test_every_figure(self):
        run = self.recorded(everything())
        for name, kind in FIGURES.items():

            def draw(ax=None, **look):
                return kind.draw(run.data, ax, **look)

            self.check(draw, PANELS.get(name, 2), name)
            with self.assertRaises((AttributeError, TypeError)):
                draw(nonsense=1)

    def test_one_of_several(self):
        """The first panel, and a name in the legend once."""
        run = self.recorded(everything())
        figure, (axes,) = self.users(1)
        FIGURES['spectrum'].draw(run, ax=axes, label='seed 7', ms=9)
        self.assertEqual(figure.axes, [axes])
        handles, labels = axes.get_legend_handles_labels()
        self.assertEqual((labels, handles[0].lines[0].get_markersize()), (['seed 7'], 9))
        spectrum = axes.containers[0].lines[0].get_ydata()
        np.testing.assert_array_equal(spectrum, test_covariant_pictures.FORWARD)
        points_of = FIGURES['dispersion'].draw(run, ax=self.users(1)[1], label='seed 7').axes[0]
        self.assertEqual(points_of.get_legend_handles_labels()[1].count('seed 7'), 1)

    def test_label_of_every_figure(self):
        run = self.recorded(everything())
        for name, kind in FIGURES.items():
            page = kind.draw(run.data, self.users(PANELS.get(name, 2))[1], label='seed 7')
            if name == 'cost':
                labels = page.axes[0].get_legend_handles_labels()[1]
                self.assertEqual(labels.count('seed 7'), 1)

    def test_sweep(self):
        paths = [
            self.write([made.run_info(density=rho), made.spectrum([9.0], 50.0)], str(rho))
            for rho in (0.4, 0.5)
        ]
        found, _ = points.read(paths)
        self.check(lambda ax=None, **look: sweep.draw(found, ax, **look), 1, 'sweep')
        for number in (30, 40):
            info = made.run_info(density=0.6, number=number)
            paths.append(self.write([info, made.spectrum([9.0], 50.0)], str(number)))
        page = sweep.draw(points.read(paths)[0], ax=self.users(1)[1])
        labels = page.axes[0].get_legend_handles_labels()[1]
        self.assertEqual(labels, [r'$\rho$ = 0.4', r'$\rho$ = 0.5', r'$\rho$ = 0.6'])

    def test_no_backend_is_chosen(self):
        """Nor does pyplot know of what is drawn."""
        program = (
            'import sys, matplotlib as m; before = dict.__getitem__(m.rcParams, "backend"); '
            'import hdlyap.plots.figures, hdlyap.sweep.figure, hdlyap.plots.movie; '
            'assert "matplotlib.pyplot" not in sys.modules; '
            'assert dict.__getitem__(m.rcParams, "backend") is before'
        )
        subprocess.run([sys.executable, '-c', program], check=True)


def is_of(artist, colour):
    """One of its colours is that one."""
    for name in ('color', 'facecolor', 'edgecolor'):
        if hasattr(artist, 'get_' + name):
            colours = to_rgba_array(getattr(artist, 'get_' + name)())[:, :3]
            if (abs(colours - to_rgba_array(colour)[:, :3]) < 1e-6).all(axis=1).any():
                return True
    return False
