"""Nodes of particles that the core does not know, without positions in a box."""

import math
import os
import subprocess

import harness
import yaml

from hdlyap.data import space

pytestmark = harness.UNDER_A_MASTER

N = 8
SCENE = dict(
    particles='chain',
    number=N,
    beta=10.0,
    energy=10.0,
    time_step=0.005,
    exponents='all',
    equilibration=10.0,
    warmup=100.0,
    duration=200.0,
    covariant_window=20.0,
    covariant_transient=100.0,
    covariant_sampling=2.0,
    observables=['spectrum', 'covariant', 'localization', 'fluctuations'],
)
NODE = harness.program('hdlyap_own_node')


class Own(harness.Case):
    def test_all_topics_of_particles_without_a_box(self):
        """Of covariant vectors all but the weights, which are of waves in a box."""
        listeners = {topic: self.listen(topic) for topic in (*SCENE['observables'], 'slow_vectors')}
        awaited = dict(SCENE, wait_for_subscribers=SCENE['observables'])
        node = self.start(awaited, command=[NODE])
        heard = {topic: listener.all_of(node) for topic, listener in listeners.items()}
        self.ends(node)
        for topic, messages in heard.items():
            self.assertTrue(messages, topic)
        self.assertEqual(len(heard['covariant']), (200 - 100) // 20)
        self.check(heard['covariant'][-1], heard['spectrum'][-1])

    def check(self, covariant, spectrum):
        self.assertEqual(covariant.weights, [])
        self.assertEqual(len(covariant.exponents), 2 * N)
        for number, exponent in enumerate(covariant.exponents):
            self.assertAlmostEqual(exponent, spectrum.exponents[number], delta=0.1)
            self.assertTrue(1 / N <= covariant.widths[number] <= 1)
            self.assertTrue(0 <= covariant.cos_theta[number] <= 1)
        self.assertEqual([angle.spaces for angle in covariant.angles], [0, 1, 2])
        self.assertTrue(all(0 < angle.mean < math.pi / 2 for angle in covariant.angles))

    def test_averages_and_coordinates(self):
        """What particles tell is published with names, units and errors; ends a run; ~state has
        all coordinates. The kinetic energy of a particle in ~state is near its mean."""
        names = ['averages', 'state']
        heard = {topic: self.listen(topic) for topic in names}
        asked = dict(SCENE, particles='telling_chain', exponents='none', warmup=0.0)
        asked.update(observables=names, duration=1e6, report_interval=20.0, target='kinetic 3%')
        del asked['covariant_window'], asked['covariant_transient'], asked['covariant_sampling']
        node = self.start(dict(asked, wait_for_subscribers=names), command=[NODE])
        told, states = (heard[topic].all_of(node) for topic in names)
        self.ends(node)
        kinetic, stretch = told[-1].averages
        self.assertEqual((kinetic.name, kinetic.unit), ('kinetic', 'energy'))
        self.assertEqual((stretch.name, stretch.unit), ('stretch', ''))
        self.assertTrue(0 < kinetic.std_error <= 0.03 * kinetic.value)
        self.assertTrue(100 < told[-1].averaged_time < 1e4)
        self.assertTrue(all(one.averages[0].std_error == -1 for one in told[:2]))
        energies = [sum(p * p for p in one.p) / 2 for one in states]
        for one, energy in zip(states, energies):
            self.assertEqual((len(one.q), len(one.p), len(one.x)), (N, N, 0))
            self.assertAlmostEqual(one.kinetic_energy, energy, places=9)
        late = energies[len(energies) // 2 :]
        spread = (max(late) - min(late)) / N / len(late) ** 0.5
        self.assertAlmostEqual(sum(late) / len(late) / N, kinetic.value, delta=4 * spread)
        status, said = self.tested('observables:=[averages]')
        self.assertEqual(status, 2)
        self.assertRegex(said, r'observables = \[averages\]: must be a list out of .* chain')

    def test_nothing_of_a_box(self):
        """Own parameters are in the log, as in --check; of a box there is no parameter, no edge."""
        info = self.listen('run_info')
        scene = dict(SCENE, scene='ring', wait_for_subscribers=['run_info'])
        node = self.start(scene, command=[NODE])
        self.ends(node)
        self.assertTrue(info.wait_for(lambda message: True))
        heard = info.messages[0]
        said = '8 chain, beta 10, energy 10, time_step 0.005, 16 vectors'
        self.assertTrue(node.lines('scene ring: ' + said))
        self.assertIn(f'scene     ring is valid: {said}\n', self.asked('--check')[1])
        names = {one.name for one in heard.parameters}
        self.assertFalse(names & set(space.OF_A_BOX))
        self.assertLess({'beta', 'energy', 'time_step', 'number'}, names)
        self.assertEqual((heard.box_x, heard.box_y, heard.box_z), (0, 0, 0))

    def test_speed_of_many(self):
        """Whose warm-up would take a minute."""
        status, said = self.asked('--check', 'number:=400', 'observables:=[spectrum, covariant]')
        self.assertEqual(status, 0)
        pattern = (
            r'speed +\S+ s per time unit, by a trial of a second, extrapolated from its \S+ time'
        )
        self.assertRegex(said, pattern + ' units of warm-up; interval ')

    def test_help(self):
        """Of the program that is run, as in what it is told to print."""
        for option in ('--help', '--parameters'):
            said = subprocess.check_output([NODE, option], text=True)
            self.assertIn('hdlyap_own_node', said)
            self.assertNotIn('hdlyap_node', said)
        self.assertIn('# For chain and lossy_chain and telling_chain only.', said)

    def test_lost_energy_without_a_time_step(self):
        """Said as it is known, with no step; and of what time the checkpoint is."""
        kept = os.path.join(self.new_folder(), 'kept')
        node = self.start(dict(SCENE, particles='lossy_chain', checkpoint=kept), command=[NODE])
        self.ends(node, 3, f'the checkpoint is {kept}; resume:=FILE goes on from it')
        self.assertTrue(node.lines('the checkpoint is not of the end, but of simulated time 0'))
        (line,) = node.lines('ended by a fault')
        self.assertRegex(line, r'at simulated time [0-9.]+: the energy is not conserved')

    def test_particles_that_share_their_parameters(self):
        """All are named, however many a program brings."""
        said = subprocess.check_output([NODE, '--parameters'], text=True)
        names = ' and '.join(f'chains_of_a_name_of_31_letters{k}' for k in range(1, 6))
        self.assertEqual(said.count(f'# For {names} only.'), 3)

    def tested(self, *arguments, keep=tuple(SCENE), **environment):
        return self.asked('--test-dynamics', *arguments, keep=keep, **environment)

    def asked(self, option, *arguments, keep=tuple(SCENE), **environment):
        """Such an option of a scene: the exit status, and what it says."""
        scene = os.path.join(self.new_folder(), 'ring.yaml')
        with open(scene, 'w') as file:
            yaml.safe_dump({name: SCENE[name] for name in keep}, file)
        done = subprocess.run(
            [NODE, option, scene, *arguments],
            capture_output=True,
            text=True,
            env=dict(os.environ, **environment),
        )
        return done.returncode, done.stdout + done.stderr

    def test_of_the_functions_of_a_row(self):
        """Of a program's own, and of the core's; the line names the function."""
        self.assertEqual(self.tested(), (0, 'ok\n'))
        status, said = self.tested('particles:=lossy_chain')
        self.assertEqual(status, 2)
        self.assertRegex(said, '^advance: the energy is not conserved')
        self.assertEqual(self.tested('beta:=-1'), (2, 'beta = -1: must be from 0 to 1000\n'))

    def test_maps_that_are_not_symplectic(self):
        """All exponents by default, which all say; half of them is refused, as no pairs give it."""
        ring = dict(particles='ring', number=4, equilibration=1.0, warmup=10.0, duration=20.0)
        listener = self.listen('run_info')
        spectra = self.listen('spectrum')
        node = self.start(
            dict(ring, observables=['spectrum'], wait_for_subscribers=['run_info', 'spectrum']),
            command=[NODE],
        )
        info, last = listener.all_of(node)[-1], spectra.all_of(node)[-1]
        self.ends(node)
        self.assertEqual({p.name: p.value for p in info.parameters}['exponents'], 'all')
        self.assertEqual(len(last.exponents), 8)
        self.assertAlmostEqual(last.exponent_sum, last.divergence, delta=1e-5)
        self.assertEqual(last.pairing_error, -1.0)
        status, said = self.tested('particles:=ring', 'number:=4', 'exponents:=positive', keep=())
        self.assertEqual(status, 2)
        self.assertRegex(said, '^exponents = positive: must be all, .* not in pairs')

    def test_row_without_a_name(self):
        status, said = self.tested(HDLYAP_NAMELESS='1')
        self.assertEqual(status, 2)
        self.assertIn("row 1 of this program's dynamics: particles: must not be NULL", said)
