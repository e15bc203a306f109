"""What a time step that is too long does to soft particles, and what is said of it."""

import os
import re

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

import harness

pytestmark = harness.UNDER_A_MASTER

SMALL = dict(particles='soft_disks', number=16, density=0.4, aspect=1.0, seed='3', threads=1)
SMALL.update(equilibration=5.0, warmup=20.0, observables=['spectrum'])


class Steps(harness.Case):
    def test_zeros_that_split(self):
        cases = [('power', 'verlet', 0.01, 0.0), ('power', 'pefrl', 0.03, 2)]
        cases += [('wca', 'verlet', 0.006, 0.67), ('wca', 'pefrl', 0.006, 0.67)]
        for potential, integrator, step, power in cases:
            scene = dict(SMALL, potential=potential, integrator=integrator, time_step=step)
            text = self.runs(dict(scene, exponents='all', duration=400.0)).text()
            self.assertNotIn('collisions', text)
            lines = re.findall(r'time_step = .* it falls as time_step\^[\d.]+', text)
            if not power:
                self.assertEqual(lines, [])
                continue
            (line,) = lines
            numbers = re.fullmatch(
                'time_step = (.*) is too long for the zero exponents: the largest is (.*), not '
                r'(.*); it falls as time_step\^(.*)',
                line,
            )
            said, largest, own, of_step = map(float, numbers.groups())
            self.assertEqual((said, own, of_step), (step, 0.015, power))  # ln 400 / 400
            self.assertGreater(largest, 0.02)

    def test_an_energy_that_is_off(self):
        """Said when it is so, and at the end; the last message and diagnostics have that of the
        end."""
        scene = dict(SMALL, exponents='none', potential='wca', integrator='verlet')
        scene.update(observables=['state'], wait_for_subscribers=['status'], duration=400.0)
        said = 'the energy has been off by .*, asked is 0.0005: take a shorter time_step or a'
        for step, is_off in ((0.006, True), (0.0, False)):
            heard = self.listen('status')
            diagnosed = self.hear('/diagnostics', DiagnosticArray)
            node = self.start(dict(scene, time_step=step))
            last = heard.all_of(node)[-1]
            self.ends(node, 0)
            self.assertEqual(len(re.findall(said, node.text())), 2 if is_off else 0)
            self.assertEqual(last.energy_error_wanted, 5e-4)
            most = last.energy_error_most
            self.assertTrue((most > 5e-4) if is_off else (most <= 5e-4))  # NaN is neither
            values = {'energy error': abs(last.energy_error), 'largest energy error': most}
            self.sees(lambda: self.values(diagnosed).get('stage') == 'finished', node)
            for key, value in values.items():
                self.assertEqual(self.values(diagnosed)[key], f'{value:.6g}')
            status = diagnosed[-1].status[0]
            self.assertEqual(status.level, DiagnosticStatus.WARN if is_off else DiagnosticStatus.OK)
            self.assertEqual(bool(re.search(said, status.message)), is_off)

    @staticmethod
    def values(diagnosed):
        """Of the last of these messages; none before the first."""
        found = diagnosed[-1].status[0].values if diagnosed else []
        return {pair.key: pair.value for pair in found}

    def test_energy_that_is_lost(self):
        """Named, with the step; what was computed stays, and no checkpoint is said that is not."""
        kept = os.path.join(self.new_folder(), 'kept')
        states = self.listen('state')
        scene = dict(SMALL, exponents='none', time_step=0.014, integrator='verlet')
        scene.update(observables=['state'], wait_for_subscribers=['state'], checkpoint=kept)
        scene.update(equilibration=0.0, duration=1e4, potential='lennard_jones', energy=0.5)
        scene.update(number=24, density=0.7, report_interval=0.1)
        node = self.start(scene)
        heard = states.all_of(node)
        self.ends(node, 3, 'the energy is not conserved: the time step is too long, 0.014')
        self.assertGreater(len(heard), 5)
        self.assertEqual('the checkpoint is' in node.text(), os.path.exists(kept))
