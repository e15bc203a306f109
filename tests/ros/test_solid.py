"""Bags of spheres that are made here: z in the arrays, names of waves, the numbers of figures and
films, walls of a sweep."""

import os
import unittest
from unittest import mock

import numpy as np
import rospkg

import bags
import hdlyap
import made
import made_fields
from made import LP, T
from hdlyap.follow import watch
from hdlyap.msg import LpPhase, State, Structure
from hdlyap.data import factors, space
from hdlyap.plots import covariant, equation, frames, movie, paper, repetition
from hdlyap.plots.figures import dispersion, modes, p_mode, spectrum
from hdlyap.plots.figures.style import scene
from hdlyap.plots.figures.view import View
from hdlyap.runs import run, work
from hdlyap.runs.scene import Refused
from hdlyap.sweep import grid, points, table

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
INFO = made.spheres()
FIRST = made.step(INFO, T, 1, 0, 53, 56)
SECOND = made.step(INFO, LP, 1, 0, 49, 52)
DEEP = made.step(INFO, T, 0, 0, 45, 48, nz=1)
FOUND = [FIRST, SECOND, DEEP]
Q, P = made_fields.balls(INFO)


def state(sim_time=150.0):
    rows = {
        name + axis: row for name, rows in (('', Q), ('p', P)) for axis, row in zip('xyz', rows)
    }
    return State(run_id='one', sim_time=sim_time, **rows)


def gas():
    return made.gas(pressure_z=1.1, pressure_z_error=0.02)


def transverse():
    """dq of T(1,0,0): 3 sin along y, 4 cos along z."""
    phase = 2 * np.pi * Q[0] / 8
    return np.array([0 * phase, 3 * np.sin(phase), 4 * np.cos(phase)])


def longitudinal():
    """dq of LP(1,0,0): L of a sine, and half as much p times a cosine."""
    phase = 2 * np.pi * Q[0] / 8
    return np.array([np.cos(phase), 0 * phase, 0 * phase]) + 0.5 * P * np.cos(phase)


class Solid(bags.Figures):
    info = INFO


class Arrays(Solid):
    def test_positions_and_fields(self):
        loaded = self.load(state(), made_fields.ball_field(INFO, FIRST, transverse()))
        for found, rows in ((loaded.state.positions(150), Q), (loaded.state.momenta(0), P)):
            np.testing.assert_array_equal(found, rows.T)
        ((time, places, momenta),) = loaded.state
        np.testing.assert_array_equal(momenta[:, 2], P[2])
        np.testing.assert_array_equal(loaded.fields[56].dqz, transverse()[2])
        self.assertEqual(repr(loaded), '<hdlyap run one: made, 20 spheres, seed 1>')

    def test_tables(self):
        """nz, three numbers, the pressure along z and its unit; of disks none of them."""
        phases = made.lp_phases(INFO, FOUND, 150.0, modulations=(0, LpPhase.SIN_Z))
        loaded = self.load(made.steps(FOUND), phases, gas())
        self.assertEqual(list(loaded.steps.index), ['T(1,0,0)', 'LP(1,0,0)', 'T(0,0,1)'])
        self.assertEqual(list(loaded.steps['nz']), [0, 0, 1])
        self.assertEqual(set(loaded.phases['step']), {'LP(1,0,0)'})
        found = loaded.gas.loc['pressure_z']
        self.assertEqual(tuple(found), (1.1, 0.02, '1/sigma^3'))
        self.assertEqual(loaded.to_xarray()['gas_pressure_z'].units, '1/sigma^3')
        flat = made.run_info()
        one = made.step(flat, LP, 1, 0, 32, 35)
        disks = self.load(made.steps([one]), made.lp_phases(flat, [one], 1.0), gas(), info=flat)
        self.assertNotIn('nz', [*disks.steps, *disks.phases])
        self.assertEqual(list(disks.steps.index), ['LP(1,0)'])
        self.assertEqual(list(disks.gas['unit'][1:4]), ['1/sigma^2'] * 3)
        self.assertNotIn('pressure_z', disks.gas.index)

    def test_files(self):
        """CSV and npz have the same columns, and name the box."""
        self.load(made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(FOUND), gas())
        folder, file = os.path.join(self.folder, 'csv'), os.path.join(self.folder, 'all.npz')
        self.succeeds('plot', self.path(), '--out', self.out, '--csv', folder, '--npz', file)
        with open(os.path.join(folder, 'steps.csv')) as lines:
            head, _, columns, first, *_ = lines
        self.assertIn('N = 20 spheres, density 0.5, box 8 x 2.5 x 2, seed 1', head)
        self.assertIn(',nx,ny,nz,', columns)
        self.assertTrue(first.startswith('"T(1,0,0)",'))
        np.testing.assert_array_equal(np.load(file)['steps.nz'], [0, 0, 1])

    def test_structure(self):
        """Eight modulations along, and across those of both fields."""
        message = Structure(run_id='one', sim_time=1.0, nx=[1, 0], ny=[0, 0], nz=[0, 1])
        message.wave_number, message.peak = [0.8, 3.1], [1, 2, 2]
        message.along, message.across = np.arange(6.0), np.ones(6)
        message.amplitude_along, message.amplitude_across = np.arange(24.0), np.arange(48.0)
        loaded = self.load(message)
        self.assertEqual(list(loaded.structure.along), [(1, 0, 0), (0, 0, 1)])
        self.assertEqual(list(loaded.structure.peaks['nz']), [1, 1, 1])
        self.assertEqual(loaded.amplitudes([2], 'along')[2].iloc[0, 7], 7 * 3 + 1)
        self.assertEqual(loaded.amplitudes([2], 'across')[2].shape, (1, 16))
        self.assertEqual(factors.amplitudes(message, 'across')[15, 2], 47)
        message.amplitude_across = np.arange(24.0)
        with self.assertRaisesRegex(
            hdlyap.data.reader.RecordingError, 'has 24 elements: must be 48'
        ):
            self.load(message).structure

    def test_damaged(self):
        """z of other length than x, a box without depth."""
        message = state()
        message.pz = message.pz[1:]
        for messages, what in (
            ([INFO, message], 'pz has 19 elements: must be 20'),
            ([made.spheres(box_z=0.0)], r'box \(0.5, 0.3125, 8.0, 2.5, 0.25, 0.0\)'),
        ):
            with self.assertRaisesRegex(hdlyap.data.reader.RecordingError, what):
                list(hdlyap.load(self.write(messages)).state)

    def test_not_of_one_run(self):
        """A box of another depth is another system, and so are disks."""
        first = self.write([INFO, made.spectrum([2.0], 5.0)], 'a')
        for other, what in (
            (made.spheres(seed='2', aspect_z=0.5), 'aspect_z is 0.25 and 0.5'),
            (made.spheres(seed='2', boundary_z='reflecting'), 'boundary_z is periodic and refl'),
        ):
            second = self.write([other, made.spectrum([2.0], 5.0)], 'b')
            with self.assertRaisesRegex(hdlyap.data.reader.RecordingError, what):
                hdlyap.load(first, second)


class Numbers(Solid):
    def test_sizes(self):
        """6N exponents, of which 8 vanish; the mean distance from a volume."""
        live = watch.View()
        live.info = INFO
        self.assertEqual((space.phase_space(INFO), live.positive_end), (120, 56))
        self.assertAlmostEqual(space.distance(INFO), 2 ** (1 / 3))
        weight = made.covariant_weight(FIRST, 56)
        self.assertEqual(covariant.chance(live, weight), 4 / 60)  # of 3N

    def test_equation(self):
        """Carnahan and Starling at eta = 0.1 and 0.4, by hand; of disks as before."""
        for eta, z in ((0.1, 1.109 / 0.729), (0.4, 1.496 / 0.216)):
            density = 6 * eta / np.pi
            self.assertAlmostEqual(equation.of(INFO).compressibility(density), z)
        self.assertIs(equation.of(made.run_info()).compressibility, equation.compressibility)

    def test_report(self):
        path = self.write(
            [INFO, made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(FOUND), gas()]
        )
        text = self.succeeds('plot', path, '--out', self.out)
        for line in (
            'N = 20 spheres, density 0.5, packing 0.2618, box 8.000 x 2.500 x 2.000, '
            'x periodic, y periodic, z periodic',
            'collision rate  3.250(20) per sphere and time unit',
            'pressure        1.250(10) per sigma^3',
            '  of px, py, pz 1.500(10), 1.000(10), 1.100(20)',
            'Z = p V / N kT  2.500(20)',
            '3.262431 by Carnahan and Starling (1969)',
            '  h_KS            336.00(56)',
            '  T(0,0,1)   45-48',
        ):
            self.assertIn(line.strip(), text)
        self.assertNotIn('Eckmann', text)

    def test_no_paper(self):
        """Its slopes and steps are of disks."""
        alike = dict(number=780, density=0.8, aspect=0.867)
        self.assertEqual(
            (paper.branches(made.spheres(**alike)), paper.steps(made.spheres(**alike))), ({}, [])
        )
        self.assertEqual(len(paper.steps(made.run_info(**alike))), 5)

    def test_compared(self):
        """T(1,0,0) and T(1,0,1) are two steps."""
        two = [made.step(INFO, T, 1, 0, 53, 56), made.step(INFO, T, 1, 0, 45, 52, nz=1)]
        paths = []
        for seed in '12':
            messages = made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(two)
            paths.append(self.write([made.spheres(seed=seed), *messages], seed))
        text = self.succeeds('compare', *paths)
        for name in ('T(1,0,0) ', 'T(1,0,1) '):
            self.assertIn('  ' + name, text)


class Figures(Solid):
    def test_title(self):
        self.assertEqual(
            scene(INFO),
            r'made: $N=20$, $\rho=0.5$, $8.00\times 2.50\times 2.00\,\sigma^3$, periodic',
        )
        self.assertTrue(
            scene(made.spheres(boundary_z='reflecting')).endswith('y periodic, z reflecting')
        )

    def test_names(self):
        messages = made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(FOUND)
        _, small = self.draw(spectrum, *messages)
        found = {text.get_text(): text.xy[0] for text in small.texts}
        self.assertEqual(found, {'T(1,0,0)': 54.5, 'LP(1,0,0)': 50.5, 'T(0,0,1)': 46.5})
        axes, upper = self.draw(dispersion, *messages)
        self.assertEqual(
            [text.get_text() for text in upper.get_xticklabels()], ['(1,0,0)', '(0,0,1)']
        )
        self.assertEqual(upper.get_xlabel(), 'nodes $(n_x,n_y,n_z)$')
        self.assertFalse([one for one in axes.get_lines() if one.get_label() == '_published'])

    def test_modes(self):
        """Arrows as the box is seen, and both components beside their sines."""
        fields = [
            made_fields.ball_field(INFO, FIRST, transverse()),
            made_fields.ball_field(INFO, SECOND, longitudinal()),
        ]
        messages = made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(FOUND)
        arrows, curves, _, along = self.draw(modes, *messages, *fields)
        scale = np.sqrt(np.mean(np.sum(transverse() ** 2, axis=0)))
        y, of_y, z, of_z, _ = curves.lines
        for dots, line, d, function, size in ((y, of_y, 1, np.sin, 3), (z, of_z, 2, np.cos, 4)):
            np.testing.assert_allclose(dots.get_xydata().T, [Q[0], transverse()[d] / scale])
            x, shown = line.get_xydata().T
            np.testing.assert_allclose(shown, size * function(np.pi * x / 4) / scale, atol=1e-9)
        self.assertEqual(curves.get_title(loc='left'), '(b) wave along $x$, 100 % in T(1,0,0)')
        dots, line, _ = along.lines
        norm = np.sqrt(np.mean(np.sum(longitudinal() ** 2, axis=0)))
        x, shown = line.get_xydata().T
        np.testing.assert_allclose(shown, np.cos(np.pi * x / 4) / norm, atol=1e-9)
        view, (quiver,) = View(INFO), [one for one in arrows.collections if hasattr(one, 'U')]
        order = view.order(Q)
        seen = view.vectors(transverse())[:, order] * modes.ARROW / scale
        np.testing.assert_allclose([quiver.U, quiver.V], seen)
        middle = quiver.get_offsets().T + 0.5 * seen
        np.testing.assert_allclose(middle, view.places(Q)[:, order])

    def test_slab(self):
        """Of many spheres the arrows in front alone: 2.6 * 8 * 2 of 400."""
        info = made.spheres(number=400)
        q, _ = made_fields.balls(info)
        field = made_fields.ball_field(info, FIRST, np.ones((3, 400)))
        messages = made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(FOUND)
        arrows = modes.draw(self.recorded([info, *messages, field])).axes[0]
        (quiver,) = [one for one in arrows.collections if hasattr(one, 'U')]
        self.assertEqual(len(quiver.U), np.sum(q[1] < 0.104 * 2.5))
        self.assertTrue(arrows.get_title(loc='left').endswith(r', $y<0.26\,\sigma$'))

    def test_several_waves(self):
        """Of steps that share a set each component against what all their fields give."""
        both = [
            made.step(INFO, T, 1, 0, 49, 56, set=49, members=2),
            made.step(INFO, T, 0, 0, 49, 56, nz=1, set=49, members=2),
        ]
        dq = transverse()
        dq[0] += np.cos(np.pi * Q[2])
        field = made_fields.ball_field(INFO, both[0], dq)
        messages = made.spectrum(np.linspace(9, 3, 56), 50.0), made.steps(both)
        _, each = self.draw(modes, *messages, field)
        self.assertEqual(each.get_title(loc='left'), '(b) each sphere, 100 % in T(1,0,0)+T(0,0,1)')
        for dots in each.lines[:3]:
            np.testing.assert_allclose(*dots.get_xydata().T, atol=1e-9)

    def test_p_mode(self):
        """Three components, each divided by its momentum: 0.9 cos kx x."""
        a = np.cos(2 * np.pi * Q[0] / 8)
        field = made_fields.ball_field(INFO, SECOND, longitudinal(), pairs=1, modulation=bytes([0]))
        field.residual_l = field.residual_p = [0.1]
        eps = p_mode.EPSILON * np.mean(P**2)
        for axis, p in zip('xyz', P):
            setattr(field, 'l_' + axis, 0 * p)
            setattr(field, 'p_' + axis, a * p)
            setattr(field, 'p_over_p' + axis, 0.9 * a * p**2 / (p**2 + eps))
        grid = self.draw(p_mode, made.steps(FOUND), field)
        self.assertEqual(len(grid), 6)
        for axes, axis, letter in zip(grid[3:], 'xyz', 'def'):
            title = rf'({letter}) $\phi_{{P,{axis}}} / p_{axis}$, fit $0.90\,\cos k_x x$'
            self.assertEqual(axes.get_title(loc='left'), title)
            x, y = axes.lines[-1].get_xydata().T
            np.testing.assert_allclose(y, 0.9 * np.cos(2 * np.pi * x / 8), atol=1e-9)
        np.testing.assert_allclose(grid[2].lines[1].get_xdata(), Q[0])

    def test_view(self):
        """All of the box, upright, what is behind paler and drawn first."""
        view = View(INFO)
        corners = np.indices((2, 2, 2)).reshape(3, -1) * np.array([[8.0], [2.5], [2.0]])
        seen = view.places(corners)
        np.testing.assert_allclose(seen.min(axis=1), view.margin)
        np.testing.assert_allclose(seen.max(axis=1), view.size - view.margin)
        self.assertTrue((view.vectors(np.eye(3))[1] * [-1, 1, 1] > 0).all())
        self.assertEqual(view.vectors(np.eye(3))[0, 2], 0)
        depth = view.depth(corners)
        self.assertEqual((depth.min(), depth.max()), (0, 1))
        np.testing.assert_array_equal(corners[:, np.argmax(depth)], [0, 2.5, 0])
        self.assertEqual(np.argmax(depth), view.order(corners)[0])
        pale = view.pale('black', corners)
        np.testing.assert_allclose(pale.max(), 0.65)


class Films(Solid):
    def test_projected(self):
        """Spheres and arrows where they are seen; names of three numbers."""
        found = [made.step(INFO, T, 1, 0, 53, 56), made.step(INFO, T, 0, 0, 45, 48, nz=1)]
        field = made_fields.ball_field(INFO, found[0], transverse())
        other = made_fields.ball_field(INFO, found[1], transverse()[[2, 1, 0]])
        path = self.write([INFO, state(140.0), made.steps(found), state(150.0), field, other])
        film = frames.Film(hdlyap.load(path), ['T(1,0,0)'])
        self.assertEqual(film.begin, 150)  # when the mode is found
        (frame,) = film.frames(1.0)
        self.assertEqual(list(frame.fields), ['T(1,0,0)'])
        picture = movie.Picture(film, 300)
        picture.show(frame)
        (panel,) = picture._panels
        view = View(INFO)
        order = view.order(Q)
        drawn = panel._particles.disks[1.0].get_offsets()
        np.testing.assert_allclose(drawn, view.places(Q)[:, order].T)
        u, v = panel._arrows.U, panel._arrows.V
        middle = panel._arrows.get_offsets().T + 0.5 * np.array([u, v])
        np.testing.assert_allclose(middle, view.places(Q)[:, order])
        turned = view.vectors(transverse())[:, order]
        np.testing.assert_allclose(u * turned[1], v * turned[0], atol=1e-12)
        self.assertRaisesRegex(
            hdlyap.data.reader.RecordingError,
            r'T\(1,0\) is not resolved in it, only T\(1,0,0\), T\(0,0,1\)',
            *(frames.Film, hdlyap.load(path), ['T(1,0)']),
        )


class Runs(unittest.TestCase):
    def runs(self, **given):
        usual = dict(scene='spheres', threads='1', params='', observables='[spectrum]')
        return grid.runs({**usual, **given}, LAUNCH, '/')

    def test_sweep(self):
        one, other = self.runs(boundaries='periodic reflecting,periodic,reflecting')
        names = ['boundary_periodic', 'boundary_reflecting_periodic_reflecting']
        self.assertEqual([one.name, other.name], names)
        self.assertEqual(
            [other.parameters[name] for name in ('particles', 'scene')], ['spheres', names[1]]
        )
        walls = [other.parameters['boundary_' + axis] for axis in 'xyz']
        self.assertEqual(walls, ['reflecting', 'periodic', 'reflecting'])
        with self.assertRaisesRegex(Refused, 'or three of them for x, y and z as reflecting,per'):
            self.runs(boundaries='periodic,reflecting')
        (flat,) = self.runs(scene='quick', seeds='1')
        self.assertEqual((flat.name, flat.parameters['particles']), ('seed_1', 'disks'))
        (solid,) = self.runs(seeds='1')
        self.assertEqual(solid.parameters['scene'], 'spheres')
        (flat,) = self.runs(seeds='1', params='{particles: disks}')
        self.assertEqual((solid.seconds - run.BEGIN) / (flat.seconds - run.BEGIN), (3 / 2) ** 2)

    def test_started(self):
        """As roslaunch is asked to."""
        (one,) = self.runs(seeds='1')
        with mock.patch.object(work, 'launched') as launched, mock.patch.object(
            one, 'write'
        ), mock.patch('builtins.open', mock.mock_open()):
            work.Job(one, '/nowhere').do('500M', [])
        self.assertIn('min_space:=500M', launched.call_args[0][0])


class Repeated(Solid):
    def test_scene(self):
        """With its particles and walls along z."""
        text = repetition.scene_file(made.spheres(boundary_z='reflecting'))
        for line in ('particles: spheres\n', 'aspect_z: 0.25\n', 'boundary_z: reflecting\n'):
            self.assertIn('\n' + line, text)
        for name in ('box_z', 'wave_nz', 'dimension:'):
            self.assertNotIn(name, text)
        self.assertNotIn('boundary_z', repetition.scene_file(made.run_info()))


class Tables(Solid):
    def test_sweep(self):
        """Both aspect ratios, densities of a volume, three boundaries; not beside disks."""
        paths = []
        for number, info in enumerate(
            (INFO, made.spheres(aspect_z=0.5, box_z=4.0, boundary_z='reflecting'), made.run_info())
        ):
            paths.append(self.write([info, made.spectrum([2.0], 50.0)], str(number)))
        found, wrong = points.read(paths)
        self.assertEqual(wrong, [f'{paths[2]}: particles = disks, but this table is of spheres'])
        self.assertEqual([one.system['aspect_z'] for one in found], [0.25, 0.5])
        walls = [one.system['boundary'] for one in found]
        self.assertEqual(walls, ['periodic', 'periodic,periodic,reflecting'])
        table.csv(found, os.path.join(self.folder, 'sweep.csv'))
        with open(os.path.join(self.folder, 'sweep.csv')) as lines:
            head, first, _ = lines
        self.assertTrue(
            head.startswith('number,density [1/sigma^3],aspect,aspect_z,boundary,seeds')
        )
        self.assertTrue(first.startswith('20,0.5,0.3125,0.25,periodic,1,50'))
