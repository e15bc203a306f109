#!/usr/bin/env python3
"""A run in a circle: what a subscriber needs to draw it, and its fields made again in numpy."""

import numpy as np

import harness
import measured
from hdlyap.msg import LpPhase, Mode
from hdlyap.data import containers, waves
from hdlyap.plots import repetition

TOPICS = ['run_info', 'spectrum', 'modes', 'steps', 'lp_phases', 'fields', 'gas', 'state']
SCENE = dict(container='circle', number=120, density=0.7, equilibration=20.0, warmup=40.0)
SCENE.update(scene='round', duration=60.0, report_interval=5.0, observables=TOPICS[1:])
SLOPE = 1e-5  # of central differences
ROUNDING = 1e-7
BITS = LpPhase.COS_M, LpPhase.SIN_M


def pair(info, field, bits):
    """The L and the P field of one modulation, [2, disks] each."""
    of = (info, field.wave_number, field.nx, bits)
    x, y = np.array(field.x), np.array(field.y)
    gradient = [
        containers.modulation(*of, x + dx, y + dy) - containers.modulation(*of, x - dx, y - dy)
        for dx, dy in ((SLOPE, 0.0), (0.0, SLOPE))
    ]
    return np.array(gradient), np.array([field.px, field.py]) * containers.modulation(*of, x, y)


class Circle(harness.Case):
    @classmethod
    def setUpClass(cls):
        cls.messages = harness.whole_run(dict(SCENE, wait_for_subscribers=TOPICS), TOPICS)
        cls.info = cls.messages['run_info'][-1]

    def test_what_draws_it(self):
        info = self.info
        radius = np.sqrt(info.number / (np.pi * info.density))
        self.assertEqual(
            (info.container, info.boundary_x, info.boundary_y), ('circle',) + 2 * ('curved',)
        )
        np.testing.assert_allclose([info.box_x, info.box_y], 2 * radius, rtol=1e-14)
        turned = 2 * np.pi * np.arange(len(info.outline_x)) / len(info.outline_x)
        np.testing.assert_allclose(info.outline_x, radius * (1 + np.cos(turned)), atol=1e-12)
        np.testing.assert_allclose(info.outline_y, radius * (1 + np.sin(turned)), atol=1e-12)
        self.assertEqual(len(turned), 128)
        self.assertEqual((info.aspect, info.zero_exponents, info.vectors), (1.0, 4, 238))
        for state in self.messages['state']:
            distance = np.hypot(np.array(state.x) - radius, np.array(state.y) - radius)
            self.assertLessEqual(distance.max(), radius - 0.5 + 1e-12)
            self.assertGreater(distance.max(), radius - 1.5)

    def test_it_can_be_repeated(self):
        asked = repetition.parameters(self.info)
        for name, value in SCENE.items():
            self.assertEqual(asked[name], value, name)
        self.assertFalse({'aspect', 'boundary_x', 'boundary_y'} & set(asked))

    def test_steps(self):
        steps = self.messages['steps'][-1].steps
        named = {(step.kind, step.nx, step.ny): step for step in steps if step.kind != Mode.ZERO}
        self.assertEqual(len(named), 13)  # the twelve longest, and one as long as the last
        lp, reach = named[Mode.LP, 1, 1], 0.5 * self.info.box_x - 0.5
        self.assertTrue(lp.resolved)
        self.assertEqual((lp.first_index, lp.last_index, lp.expected), (235, 238, 4))
        for key, root in (((Mode.LP, 1, 1), 1.84118), ((Mode.T, 2, 1), 4.61256)):
            self.assertAlmostEqual(named[key].wave_number * reach, root, places=4)
        self.assertEqual(self.messages['steps'][-1].l_points, 0)
        self.assertGreater(self.messages['steps'][-1].t_points, 0)
        measured.check(self, self.messages['steps'])
        bits = {phase.modulation for phase in self.messages['lp_phases'][-1].phases}
        self.assertEqual(bits, set(BITS))
        self.assertEqual(waves.plain_formula(2, 1, LpPhase.SIN_M), 'J2(kr) sin 2theta')

    def test_weights(self):
        """By least squares on the fields, of all vectors of the same time."""
        modes = {message.sim_time: message.modes for message in self.messages['modes']}
        checked = 0
        for field in self.messages['fields']:
            if field.kind != Mode.LP or field.sim_time not in modes:
                continue
            fields = [part.ravel() for bits in BITS for part in pair(self.info, field, bits)]
            basis = np.array(fields[: 4 if field.nx else 2]).T
            vector = np.array([field.dqx, field.dqy]).ravel()
            basis, vector = basis / np.linalg.norm(basis, axis=0), vector / np.linalg.norm(vector)
            found = basis @ np.linalg.lstsq(basis, vector, rcond=None)[0]
            mode = modes[field.sim_time][field.index - 1]
            self.assertAlmostEqual(np.sum(found**2), mode.weight_now, delta=ROUNDING)
            checked += 1
        self.assertGreater(checked, 3)

    def test_gas(self):
        gas = self.messages['gas'][-1]
        area = np.pi * (0.5 * self.info.box_x - 0.5) ** 2
        self.assertAlmostEqual(
            gas.compressibility, gas.pressure * area / self.info.number, places=9
        )
        self.assertAlmostEqual(gas.compressibility, 5.25, delta=0.15)  # with 480 disks 5.175


if __name__ == '__main__':
    harness.main('circle')
