"""Bags of dumbbells that are made here: angles and spins in the arrays, their own parameters, both
disks and colours in figures and films, the share of rotation."""

import os

import numpy as np
from matplotlib.colors import to_rgb

import bags
import hdlyap
import made
import made_fields
from made import LP, T
from hdlyap import parameters
from hdlyap.data import space
from hdlyap.data.reader import RecordingError
from hdlyap.msg import Mode, Modes, State
from hdlyap.plots import equation, frames, movie, paper, repetition
from hdlyap.plots.figures import dispersion, modes, spectrum
from hdlyap.plots.figures.style import scene
from hdlyap.plots.figures.turning import LEFT, RIGHT
from hdlyap.sweep import figure, points, table

OWN = ['bond=0.25', 'inertia=disks']
ANGLES = np.linspace(0, 6, 20)
SPINS = np.linspace(-9, 9, 20)
TURNED = np.linspace(-0.2, 0.3, 20)  # dq_angle
FULL = 2 * np.sqrt(2 / 3 / 0.140625)  # spin of the full colour, kT being 2/3


def dumbbells(**fields):
    """Twenty in a box of 8 x 5: 120 exponents, of which six vanish."""
    usual = dict(particles='dumbbells', coordinates=3, inertia=0.140625, own=OWN, aspect=0.625)
    usual.update(sites=[-0.125, 0.125], box_x=8.0, box_y=5.0, packing_fraction=0.517)
    return made.run_info(**{**usual, **fields})


INFO = dumbbells()
FOUND = [made.step(INFO, T, 1, 0, 56, 57), made.step(INFO, LP, 1, 0, 52, 55)]
X, Y, PX, PY = made_fields.disks(INFO)
ARMS = 0.125 * np.array([np.cos(ANGLES), np.sin(ANGLES)])
ENDS = np.array([[X, Y] - ARMS, [X, Y] + ARMS])


def state(sim_time=150.0, **fields):
    usual = dict(x=X, y=Y, px=PX, py=PY, angle=ANGLES, spin=SPINS)
    return State(run_id='one', sim_time=sim_time, **{**usual, **fields})


def field(one=FOUND[0], **fields):
    turned = dict(angle=ANGLES, spin=SPINS, dq_angle=TURNED, dp_angle=TURNED)
    return made_fields.mode_field(INFO, one, **turned, **fields)


def shares(*of_each):
    """Modes, from the index 52 on."""
    found = [Mode(index=52 + k, kind=LP, rotation=one) for k, one in enumerate(of_each)]
    return Modes(run_id='one', sim_time=150.0, averaged_time=50.0, modes=found)


def colours(parts, still):
    """From the colour of what stands still to that of its sign."""
    full = np.where(np.array(parts)[:, None] > 0, to_rgb(LEFT), to_rgb(RIGHT))
    part = np.minimum(np.abs(parts), 1)[:, None]
    return to_rgb(still) + part * (full - to_rgb(still))


def strength(one):
    return np.sqrt(np.mean(np.array([one.dqx, one.dqy, one.dq_angle]) ** 2) * 3)


class Dumbbells(bags.Figures):
    info = INFO


class Arrays(Dumbbells):
    def test_angles(self):
        loaded = self.load(state(), field(), shares(0.25))
        np.testing.assert_array_equal(loaded.state.angles(150.0), ANGLES)
        np.testing.assert_array_equal(loaded.state.spins(150.0), SPINS)
        np.testing.assert_array_equal(loaded.state.positions(150.0), np.array([X, Y]).T)
        np.testing.assert_array_equal(loaded.fields[57].dq_angle, TURNED)
        self.assertEqual(loaded.modes.loc[52, 'rotation'], 0.25)
        flat = self.load(shares(0.0), info=made.run_info())
        self.assertNotIn('rotation', flat.modes)

    def test_named(self):
        loaded = self.load(state())
        self.assertEqual((loaded.info.particles, loaded.info.inertia), ('dumbbells', 0.140625))
        self.assertEqual(loaded.own, {'bond': 0.25, 'inertia': 'disks'})
        self.assertEqual(repr(loaded), '<hdlyap run one: made, 20 dumbbells, seed 1>')

    def test_disks(self):
        """Both of each, half a bond from its place; disks have one."""
        q = np.array([X, Y])
        np.testing.assert_allclose(space.disks(INFO, q, ANGLES), ENDS)
        self.assertIs(space.disks(made.run_info(), q)[0], q)
        self.assertIs(space.disks(dumbbells(sites=[0.0]), q, ANGLES)[0], q)

    def test_damaged(self):
        """An angle less than dumbbells, a vector without what turns them."""
        bare = field()
        bare.dq_angle = []
        for message, read in (
            (state(spin=SPINS[1:]), lambda run: list(run.state)),
            (state(angle=[]), lambda run: list(run.state)),
            (bare, lambda run: run.fields),
        ):
            with self.assertRaisesRegex(
                RecordingError, r'(angle|spin) has \d+ elements: must be 20'
            ):
                read(self.load(message))

    def test_not_of_one_run(self):
        first = self.write([INFO, made.spectrum([2.0], 5.0)], 'a')
        other = dumbbells(seed='2', own=['bond=0.5', 'inertia=disks'])
        second = self.write([other, made.spectrum([2.0], 5.0)], 'b')
        with self.assertRaisesRegex(RecordingError, 'bond is 0.25 and 0.5'):
            hdlyap.load(first, second)


class Texts(Dumbbells):
    def test_report(self):
        """Without a reference, nor the paper's slopes, which are of disks."""
        path = self.write(
            [INFO, made.spectrum(np.linspace(9, 3, 57), 50.0), made.steps(FOUND), made.gas()]
        )
        text = self.succeeds('plot', path, '--out', self.out)
        for line in (
            'N = 20 dumbbells, bond 0.25, inertia disks, density 0.5, packing 0.517, box',
            'collision rate  3.250(20) per dumbbell and time unit',
            'Z = p A / N kT  2.500(20)',
            '  h_KS            342.00(57)',
        ):
            self.assertIn(line.strip(), text)
        for name in 'Eckmann', 'Henderson':
            self.assertNotIn(name, text)
        folder = os.path.join(self.folder, 'csv')
        self.succeeds('plot', path, '--out', self.out, '--csv', folder)
        with open(os.path.join(folder, 'steps.csv')) as lines:
            self.assertIn('N = 20 dumbbells, bond 0.25, inertia disks, density', next(lines))

    def test_no_paper(self):
        self.assertIsNone(equation.of(INFO))
        alike = dict(number=780, density=0.8, aspect=0.867)
        self.assertEqual(
            (paper.branches(dumbbells(**alike)), paper.steps(dumbbells(**alike))), ({}, [])
        )

    def test_repeated(self):
        text = repetition.scene_file(INFO)
        for line in ('particles: dumbbells\n', 'bond: 0.25\n', 'inertia: disks\n'):
            self.assertIn('\n' + line, text)
        for name in 'packing_fraction', 'coordinates', 'own', 'boundary_z':
            self.assertNotIn(name, text)

    def test_title(self):
        self.assertEqual(
            scene(INFO),
            r'made: $N=20$ dumbbells, bond 0.25, inertia disks'
            '\n'
            r'$\rho=0.5$, $L_y/L_x=0.625$, periodic',
        )


class Figures(Dumbbells):
    def test_rotation(self):
        """Of each vector, below its exponent, with that of a vector without preference."""
        messages = made.spectrum(np.linspace(9, 3, 57), 50.0), made.steps(FOUND)
        of_each = 0.11, 0.12, 0.13, 0.14, 0.02, 0.03
        *_, whole, small = self.draw(spectrum, *messages, shares(*of_each))
        for axes in whole, small:
            line, *dots, chance = axes.lines
            np.testing.assert_allclose(line.get_xydata().T, [range(52, 58), of_each])
            self.assertEqual([dot.get_ydata()[0] for dot in dots], list(of_each))
            self.assertEqual(set(chance.get_ydata()), {1 / 3})
            self.assertEqual(axes.get_ylabel(), 'share of rotation')
        names = [dot.get_color() for dot in small.lines[1:-1]]
        self.assertEqual(names, 4 * ['#D55E00'] + 2 * ['#0072B2'])  # of LP, of T
        self.assertEqual(len(self.draw(spectrum, *messages)), 2)  # not recorded

    def test_no_published_branch(self):
        axes, _ = self.draw(dispersion, made.spectrum([2.0], 50.0), made.steps(FOUND))
        self.assertFalse([one for one in axes.get_lines() if one.get_label() == '_published'])

    def test_modes(self):
        """Both disks in the colour of what turns them, the bond, and arrows that are the shorter
        the more of the vector turns."""
        one = field()
        messages = made.spectrum(np.linspace(9, 3, 57), 50.0), made.steps(FOUND)
        (axes,) = self.draw(modes, *messages, one)
        rims, bonds, circles = axes.collections[:3]
        arrows = axes.collections[3]
        bonds, rims = (bonds, rims) if hasattr(bonds, 'get_segments') else (rims, bonds)
        for drawn in rims, circles:
            np.testing.assert_allclose(drawn.get_offsets(), np.hstack(ENDS).T)
        np.testing.assert_allclose(bonds.get_segments(), np.transpose(ENDS, (2, 0, 1)))
        wanted = colours(TURNED / strength(one), 'white')
        np.testing.assert_allclose(circles.get_facecolors()[:, :3], np.tile(wanted, (2, 1)))
        np.testing.assert_allclose(arrows.U, modes.ARROW * one.dqx / strength(one))
        np.testing.assert_allclose(arrows.get_offsets().T, [X, Y])
        self.assertIn('green: turned to the left', axes.figure._suptitle.get_text())

    def test_channel(self):
        """Three components, the mean square of all together being one."""
        info, one = dumbbells(box_x=25.0, box_y=1.6), field()
        messages = made.spectrum(np.linspace(9, 3, 57), 50.0), made.steps(FOUND)
        (axes,) = modes.draw(self.recorded([info, *messages, one])).axes
        for line, name in zip(axes.lines, ('x', 'y', 'angle')):
            values = np.array(getattr(one, 'dq' + (name if len(name) == 1 else '_' + name)))
            np.testing.assert_allclose(line.get_ydata(), values / strength(one))
        self.assertNotIn('green', axes.figure._suptitle.get_text())


class Films(Dumbbells):
    def test_molecules(self):
        """Coloured by their spin while the vector is not known, then by that."""
        one = field(sim_time=160.0)
        path = self.write([INFO, state(150.0), made.steps(FOUND), one])
        film = frames.Film(hdlyap.load(path), ['T(1,0)'], (150.0, None))
        picture = movie.Picture(film, 300)
        (panel,) = picture._panels
        for frame, parts in zip(film.frames(10.0), (SPINS / FULL, TURNED / strength(one))):
            picture.show(frame)
            disks = panel._particles.disks[1.0]
            np.testing.assert_allclose(disks.get_offsets(), np.hstack(ENDS).T)
            wanted = np.tile(colours(parts, movie.DISK), (2, 1))
            np.testing.assert_allclose(disks.get_facecolors()[:, :3], wanted)
        scale = movie.ARROW * space.distance(INFO) / strength(one)
        short = np.hypot(panel._arrows.U, panel._arrows.V) < movie.LONGEST * space.distance(INFO)
        np.testing.assert_allclose(panel._arrows.U[short], scale * one.dqx[short])
        texts = [text.get_text() for text in picture.figure.texts]
        self.assertIn('\u25cf turns left', texts)


class Tables(Dumbbells):
    def test_sweep(self):
        """By their own parameters, numbers before words."""
        paths = []
        for number, own in enumerate(
            (OWN, ['bond=0.25', 'inertia=0.5'], ['bond=0.1', 'inertia=points'])
        ):
            info = dumbbells(own=own)
            parameters.named(info, 'bond').unit = 'sigma'
            paths.append(self.write([info, made.spectrum([2.0], 50.0)], str(number)))
        found, wrong = points.read(paths)
        self.assertEqual(wrong, [])
        own = [(one.system['bond'], one.system['inertia']) for one in found]
        self.assertEqual(own, [(0.1, 'points'), (0.25, 0.5), (0.25, 'disks')])
        first, head, *_ = table.text(found)
        self.assertIn('density 0.5', first)
        self.assertEqual(head.split()[:2], ['bond', 'inertia'])
        drawn = figure.draw(found).figure
        self.assertEqual(drawn.axes[0].get_xlabel(), r'bond  [$\sigma$]')
        (labels,) = [one.get_texts() for one in drawn.legends]
        self.assertEqual(
            [text.get_text() for text in labels],
            ['inertia = points', 'inertia = 0.5', 'inertia = disks'],
        )
        shifted = 'points of each series are shifted along x'
        self.assertIn(shifted, drawn.texts[-1].get_text())
        places = sorted({one.lines[0].get_xdata()[0] for one in drawn.axes[0].containers})
        np.testing.assert_allclose(places, [0.1 - 0.0018, 0.25, 0.25 + 0.0018])
        words = figure.draw(found[1:]).figure  # of one bond
        self.assertNotIn(shifted, words.texts[-1].get_text())
        ticks = [text.get_text() for text in words.axes[0].get_xticklabels()]
        self.assertEqual(ticks, ['0.5', 'disks'])
