"""Bags of mixtures that are made here: each particle at its size, displacements by its mass, the
share of the second kind, rates of pairs, sweeps and comparisons."""

import numpy as np
from matplotlib.figure import Figure

import bags
import hdlyap
import made
import made_fields
from made import LP, T
from hdlyap.data import space
from hdlyap.data.reader import RecordingError
from hdlyap.msg import Mode, Modes, State
from hdlyap.plots import equation, expected, frames, movie, paper, report
from hdlyap.plots.figures import box, modes, p_mode, spectrum
from hdlyap.plots.figures.style import scene
from hdlyap.sweep import points, table

KINDS = [13, 7], [1.0, 1.4], [1.0, 4.0]
OWN = ['second_fraction=0.35', 'second_diameter=1.4', 'second_mass=4.0']
ROOTS = np.repeat([1.0, 2.0], KINDS[0])


def mixture(kinds=KINDS, own=tuple(OWN), **fields):
    """Twenty disks in a box of 8 x 5."""
    names = 'kind_numbers', 'kind_diameters', 'kind_masses'
    usual = dict(zip(names, kinds), own=own, aspect=0.625, box_x=8.0, box_y=5.0)
    return made.run_info(**{**usual, **fields})


INFO = mixture()
FOUND = [made.step(INFO, T, 1, 0, 36, 37), made.step(INFO, LP, 1, 0, 32, 35)]
X, Y, PX, PY = made_fields.disks(INFO)


def field(one=FOUND[0], **fields):
    return made_fields.mode_field(INFO, one, **fields)


def shares(*of_each):
    """Modes, from the index 32 on."""
    found = [Mode(index=32 + k, kind=LP, second_kind=one) for k, one in enumerate(of_each)]
    return Modes(run_id='one', sim_time=150.0, averaged_time=50.0, modes=found)


def gas():
    rates = {'collision_rate_' + pair: 1.0 + k for k, pair in enumerate(space.PAIRS)}
    rates.update({name + '_error': 0.02 for name in rates})
    rates.update({'expected_rate_' + pair: 1.1 + k for k, pair in enumerate(space.PAIRS)})
    return made.gas(collision_rate=6.0, expected_compressibility=2.75, **rates)


def sizes(collection):
    """Diameters of the outlines."""
    return set(2 * np.ravel(collection._widths))


class Mixtures(bags.Figures):
    info = INFO


class Arrays(Mixtures):
    def test_kinds(self):
        loaded = self.load(shares(0.25), gas())
        np.testing.assert_array_equal(space.diameters(INFO), np.repeat([1.0, 1.4], [13, 7]))
        np.testing.assert_array_equal(space.roots(INFO), ROOTS)
        self.assertEqual(loaded.modes.loc[32, 'second_kind'], 0.25)
        self.assertEqual(tuple(loaded.gas.loc['collision_rate_12'])[:2], (2.0, 0.02))
        self.assertEqual(loaded.course('gas')['expected_rate_22'].iloc[-1], 3.1)
        self.assertEqual(float(loaded.to_xarray()['gas_collision_rate_22'][-1]), 3.0)
        flat = self.load(shares(np.nan), made.gas(), info=made.run_info())
        self.assertNotIn('second_kind', flat.modes)
        self.assertNotIn('collision_rate_11', flat.gas.index)

    def test_displacements(self):
        one = field()
        np.testing.assert_allclose(
            space.displacements(one, INFO), np.array([one.dqx, one.dqy]) / ROOTS
        )
        flat = made.run_info()
        np.testing.assert_array_equal(space.displacements(one, flat), [one.dqx, one.dqy])

    def test_without_info(self):
        """Messages alone show that there are two kinds."""
        for message, is_mixture in ((shares(0.25), True), (shares(np.nan), False)):
            path = self.write([message, made.spectrum([2.0], 5.0)])
            self.assertEqual(space.is_mixture(hdlyap.load(path).info), is_mixture)

    def test_damaged(self):
        wrong = mixture(([13, 8], *KINDS[1:]))
        with self.assertRaisesRegex(RecordingError, 'kind_numbers = .*: must be '):
            self.load(gas(), info=wrong)

    def test_not_of_one_run(self):
        """A second kind, or another mass, makes another system."""
        first = self.write([INFO, made.spectrum([2.0], 5.0)], 'a')
        heavy = mixture((*KINDS[:2], [1.0, 9.0]), OWN[:2] + ['second_mass=9.0'], seed='2')
        pure = made.run_info(aspect=0.625, box_x=8.0, box_y=5.0, seed='2')
        for other, said in ((heavy, 'second_mass is 4.0 and 9.0'), (pure, 'kind_diameters')):
            second = self.write([other, made.spectrum([2.0], 5.0)], 'b')
            for paths in ((first, second), (second, first)):
                with self.assertRaisesRegex(RecordingError, f'{said}|second_fraction|and 4.0'):
                    hdlyap.load(*paths)


class Texts(Mixtures):
    def test_report(self):
        """Rates of pairs beside theory; nothing that holds for one kind."""
        messages = [INFO, made.spectrum(np.linspace(9, 3, 37), 50.0), made.steps(FOUND), gas()]
        text = self.succeeds('plot', self.write(messages), '--out', self.out)
        for line in (
            'N = 20 disks, second fraction 0.35, second diameter 1.4, second mass 4, density 0.5',
            '  pairs 11, 12, 22 1.000(20), 2.000(20), 3.000(20)',
            '  by theory     1.1, 2.1, 3.1; Z 2.75',
        ):
            self.assertIn(line, text)
        self.assertNotIn('Henderson', text)
        for kinds in (KINDS, ([20], [1.4], [1.0]), ([20], [1.0], [4.0])):  # all of the second kind
            self.assertIsNone(equation.of(mixture(kinds)))
            many = [780 if len(kinds[0]) == 1 else 773, 7][: len(kinds[0])], *kinds[1:]
            large = dict(number=780, density=0.8, aspect=0.867)
            self.assertEqual(paper.branches(mixture(many, **large)), {})
        of_the_paper = made.run_info(**large)
        self.assertNotEqual(paper.branches(of_the_paper), {})
        sheared = made.run_info(**large, boundary_y='shearing')
        self.assertEqual(paper.branches(sheared), {})

    def test_title(self):
        own = 'second fraction 0.35, second diameter 1.4, second mass 4'
        self.assertIn(f'$N=20$ disks\n{own}\n', scene(INFO))
        self.assertEqual(space.named(made.run_info()), '')
        round_box = dict(container='circle', boundary_x='curved', boundary_y='curved')
        for info, said in ((mixture(**round_box), own), (made.run_info(**round_box), '')):
            self.assertIn(said, scene(info))
            self.assertIn(said, report.system(info))
        for wall, said in (('shearing', 'periodic, y shearing, $b=10$'), ('reflecting', '')):
            self.assertTrue(scene(made.run_info(boundary_y=wall)).endswith(said))

    def test_table(self):
        """With and without a second kind in one table."""
        pure = made.run_info(own=[])
        for name, text in (one.split('=') for one in OWN):  # which a node tells, but not as own
            usual = '0.0' if name == 'second_fraction' else '1.0'
            pure.parameters.append(made.parameter(name, float(usual)))
        paths = [
            self.write([info, made.spectrum([2.0], 50.0)], name)
            for name, info in (
                ('a', pure),
                ('b', mixture(box_x=40**0.5, box_y=40**0.5, aspect=1.0)),
            )
        ]
        found, wrong = points.read(paths)
        self.assertEqual((wrong, len(found)), ([], 2))
        names, _ = points.varied(found)
        self.assertEqual(names, [one.partition('=')[0] for one in OWN])
        self.assertEqual([one.system['second_mass'] for one in found], [1.0, 4.0])
        self.assertIn('second_mass', '\n'.join(table.text(found)))


class Pictures(Mixtures):
    def test_particles(self):
        """Each in its size, also where they are moved in another order."""
        axes = Figure().add_subplot()
        q = np.array([X, Y])
        drawn = box.Particles(axes, INFO, q, size=0.5)
        self.assertEqual(sorted(drawn.disks), [1.0, 1.4])
        for order in (np.arange(20), np.arange(20)[::-1], np.arange(10, 20)):
            drawn.move(q[:, order], (), order)
            for size, first, end in ((1.0, 0, 13), (1.4, 13, 20)):
                inside = [k for k in order if first <= k < end]
                places = drawn.disks[size].get_offsets()
                np.testing.assert_allclose(places, q[:, inside].T)
                np.testing.assert_allclose(list(sizes(drawn.disks[size])), [0.5 * size])

    def test_arrows(self):
        """Of displacements, in figures and films."""
        one = field(noise=0.0)
        moved = np.array([one.dqx, one.dqy]) / ROOTS
        strength = np.sqrt(np.mean(np.sum(moved**2, axis=0)))
        panel = modes.Panel(one, INFO)
        np.testing.assert_allclose(panel.arrows, moved * modes.ARROW / strength)
        state = State(run_id='one', sim_time=150.0, x=X, y=Y, px=PX, py=PY)
        path = self.write([INFO, state, made.steps(FOUND), field(sim_time=160.0)])
        film = frames.Film(hdlyap.load(path), ['T(1,0)'], (150.0, None))
        picture = movie.Picture(film, 300)
        (shown,) = picture._panels
        for frame in film.frames(10.0):
            picture.show(frame)
        self.assertEqual(sorted(shown._particles.disks), [1.0, 1.4])
        moved = np.array([field().dqx, field().dqy]) / ROOTS
        scale = movie.ARROW * space.distance(INFO) / np.sqrt(np.mean(np.sum(moved**2, axis=0)))
        u, v = shown._arrows.U, shown._arrows.V
        short = np.hypot(u, v) < 0.999 * movie.LONGEST * space.distance(INFO)
        np.testing.assert_allclose(u[short], scale * moved[0][short])

    def test_l_part(self):
        """Projected where modes are orthogonal, shown where particles move."""
        one = field(FOUND[1])
        one.l_x, one.l_y = np.tile(one.dqx, 2), np.tile(one.dqy, 2)
        (block,) = [b for b in modes.steps.blocks(made.steps(FOUND), INFO) if b.kind == LP]
        panel = modes.Panel(one, INFO, block).show_l()
        np.testing.assert_allclose(panel.dq, np.array([one.dqx, one.dqy]) / ROOTS)

    def test_momenta_of_p_modes(self):
        """Those that P modes follow are over the root of the mass."""
        mode = p_mode.PMode(field(FOUND[1]), 0, INFO)
        np.testing.assert_allclose(mode._p, np.array([PX, PY]) / ROOTS)

    def test_shares(self):
        """Of the spectrum's vectors, and what a random vector has."""
        messages = made.spectrum(np.linspace(9, 3, 37), 50.0), made.steps(FOUND)
        *_, axes = self.draw(spectrum, *messages, shares(0.2, 0.7))
        self.assertEqual(axes.get_ylabel(), 'share of 2nd kind')
        line, *_, chance = axes.lines
        np.testing.assert_allclose(line.get_xydata().T, [[32, 33], [0.2, 0.7]])
        self.assertEqual(set(chance.get_ydata()), {0.35})


class Solid(Mixtures):
    def test_fits(self):
        """Fields are displacements, whatever the masses: those of T alone fit it exactly, and
        weights are those of the weighted coordinates."""
        kinds = [12, 8], [1.0, 1.4], [1.0, 4.0]
        info = made.spheres(**dict(zip(('kind_numbers', 'kind_diameters', 'kind_masses'), kinds)))
        roots = np.repeat([1.0, 2.0], [12, 8])
        first = made.step(info, T, 1, 0, 10, 13)
        q, _ = made_fields.balls(info)
        shape = np.array([0 * q[0], np.cos(2 * np.pi * q[0] / info.box_x), 0 * q[0]])
        one = expected.Expected(made_fields.ball_field(info, first, shape * roots), [first], info)
        np.testing.assert_allclose(one.projection, one.dq, atol=1e-12)
        np.testing.assert_allclose(one.dq, shape / np.sqrt(np.mean(np.sum(shape**2, axis=0))))
        self.assertAlmostEqual(one.weight, 1.0, places=12)
