"""Bags whose LP phases turn as is known; for the tests of parts 6, 7 and 13 of the reproduction."""

import numpy as np

from hdlyap.msg import LpPhase, LpPhases

from reproduced import Part

WEAK = LpPhase.WEAK


class Turned(Part):
    """A part that needs one run: bags with waves of known angular velocity."""

    def bag(self, *messages):
        return super().bag('run', messages)

    def rows(self, bag):
        return super().rows({self.of.RUN: bag})

    def figures(self, bag):
        return super().figures({self.of.RUN: bag})

    def tables(self, bag):
        return super().tables({self.of.RUN: bag})


class Wave:
    """z = amplitude exp(i phase(t)) for every vector and pair; phase: a rate, or a function of
    time. With short below 1 a circle becomes an ellipse with that axis along b, on which |z| and
    the rate depend on the phase.
    """

    short = 1.0
    begun = ()  # times at which tracking begins anew

    def __init__(self, nx, ny, bits, amplitudes, rate, step=0, index=32):
        self.nx, self.ny, self.bits, self.step, self.index = nx, ny, bits, step, index
        self.amplitudes = np.array(amplitudes, dtype=complex)
        self.turned = rate if callable(rate) else lambda t: rate * t
        self.weak = lambda t, vector, pair: False
        self.sign = 1  # of the vectors, against that with which their tracking began

    def at(self, t):
        for vector, row in enumerate(self.amplitudes):
            for pair, amplitude in enumerate(row):
                turn = float(np.angle(amplitude) + self.turned(t))
                on_circle = np.exp(1j * turn)
                z = abs(amplitude) * (on_circle.real + 1j * self.short * on_circle.imag)
                phase = turn + np.angle(z / on_circle)
                since = max((begin for begin in self.begun if begin <= t), default=0.0)
                if since:
                    phase -= (
                        2 * np.pi * round((np.angle(amplitude) + self.turned(since)) / (2 * np.pi))
                    )
                one = LpPhase(
                    step=self.step,
                    nx=self.nx,
                    ny=self.ny,
                    modulation=self.bits[pair],
                    index=self.index + vector,
                    state=LpPhase.TRACKED,
                    a=z.real,
                    b=z.imag,
                    phase=phase,
                    omega=1.0,
                    omega_error=0.1,
                    tracked_time=t - since,
                )
                one.a, one.b = self.sign * one.a, self.sign * one.b
                if self.weak(t, vector, pair):
                    one.state, one.phase, one.a, one.b = WEAK, 1e3 * np.sin(1e3 * t), 0.1, -0.1
                yield one


def course(times, *waves):
    return [
        LpPhases(run_id='one', sim_time=t, phases=[one for wave in waves for one in wave.at(t)])
        for t in times
    ]
