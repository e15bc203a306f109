#!/usr/bin/env python3
"""~gas: collision rate and pressure of a run, against its other topics, kinetic theory and itself.
"""

import math


import harness
from hdlyap.plots import equation

GAS = dict(
    disks=60,
    density=0.4,
    aspect=0.5,
    equilibration=20.0,
    warmup=0.0,
    duration=1500.0,
    report_interval=50.0,
    threads=1,
    exponents='none',
    observables=['gas', 'state'],
    wait_for_subscribers='all',
)
HEARD = ['run_info', 'status', 'cost', 'gas', 'state']
NUMBERS = 'collision_rate', 'pressure', 'pressure_x', 'pressure_y'


def exact_impact(disks, free):
    """Mean |p.n| of a collision: of `free` momenta that are uniform on a sphere."""
    gammas = math.exp(math.lgamma((free + 1) / 2) - math.lgamma(free / 2))
    return math.sqrt(4 * math.pi * disks) / free * gammas


class Gas(harness.Case):
    def run_of(self, **params):
        return harness.whole_run(dict(GAS, **params), HEARD)

    def check(self, messages, free, area):
        """What each of them says fits together; the last one has errors."""
        disks = GAS['disks']
        for message in messages:
            self.assertAlmostEqual(
                message.pressure, (message.pressure_x + message.pressure_y) / 2, places=12
            )
            self.assertAlmostEqual(message.compressibility, message.pressure * area / disks)
        last = messages[-1]
        for name in NUMBERS:
            error = getattr(last, name + '_error')
            self.assertTrue(0 < error < 0.05 * getattr(last, name), name)
        self.assertTrue(any(message.pressure_error == -1 for message in messages[:1]))
        virial = 4 * (last.compressibility - 1)  # 2 W / (N t), as compressibility - 1 is W / 2 N t
        ratio = virial / (exact_impact(disks, free) * last.collision_rate)
        error = last.pressure_error / (last.pressure - disks / area)
        self.assertAlmostEqual(ratio, 1, delta=3 * error)
        return last

    def test_periodic(self):
        messages = self.run_of()
        info = messages['run_info'][-1]
        last = self.check(messages['gas'], 2 * 60 - 2, info.box_x * info.box_y)
        z, error = last.compressibility, last.pressure_error / last.pressure * last.compressibility
        allowed = 0.01 + (z - 1) / 60  # of Henderson's equation, and of so few disks
        self.assertAlmostEqual(z, equation.compressibility(0.4), delta=3 * error + allowed)
        reports = [message.sim_time for message in messages['state']][-30:]
        self.assertEqual([message.sim_time for message in messages['gas']], reports)
        for message in messages['gas']:
            self.assertAlmostEqual(message.averaged_time, message.sim_time - 20, places=9)

    def test_walls(self):
        messages = self.run_of(boundary_x='reflecting', boundary_y='reflecting')
        info = messages['run_info'][-1]
        last = self.check(messages['gas'], 2 * 60, (info.box_x - 1) * (info.box_y - 1))
        self.assertGreater(last.pressure, 0.4 * equation.compressibility(0.4))

    def test_with_exponents(self):
        """Over the same time as these; its collisions are those that they are told with."""
        topics = ['spectrum', 'gas']
        params = dict(GAS, exponents='positive', duration=60.0, warmup=20.0, report_interval=1.0)
        messages = harness.whole_run(
            dict(params, observables=topics), ['run_info', 'status', 'cost', *topics]
        )
        self.assertGreater(len(messages['gas']), 30)
        averaged = {message.sim_time: message.averaged_time for message in messages['spectrum']}
        self.assertEqual({m.sim_time: m.averaged_time for m in messages['gas']}, averaged)
        spectra = {message.sim_time: message for message in messages['spectrum']}
        first, last = (
            next(m for m in some if abs(m.sim_time - 40 - m.averaged_time) < 1e-9)
            for some in (messages['gas'], messages['gas'][::-1])
        )
        self.assertLess(first.averaged_time, last.averaged_time)
        counted = [m.collision_rate * m.averaged_time * 60 / 2 for m in (first, last)]
        self.assertAlmostEqual(
            counted[1] - counted[0],
            spectra[last.sim_time].collisions - spectra[first.sim_time].collisions,
            places=6,
        )


class Demand(harness.Case):
    def test_nobody(self):
        calls = harness.calls(self, dict(GAS, duration=100.0, wait_for_subscribers=[]))
        self.assertEqual(calls['gas_publish'], 0)


if __name__ == '__main__':
    harness.main('gas')
