#!/usr/bin/env python3
"""Only what a scene asks for is executed: counts of instructions, never times.
   instructions.py VALGRIND LOAD CORE"""

import functools
import os
import sys
import unittest

sys.dont_write_bytecode = True  # the sources stay as they are

import callgrind  # noqa: E402

VALGRIND, LOAD, CORE = sys.argv[1:4]
NONE, POSITIVE, ALL = 0, -1, -2  # HD_EXPONENTS_*
MODES, STEPS, PHASES, EVERYTHING, GAS, WIDTHS = 1, 2, 4, 223, 256, 512  # HD_OBSERVE_*

# sources of each stage; what is common to all is in none
OF_TRAJECTORY = {'trajectory.c', 'prediction.c', 'contact.h', 'cells.c', 'queue.c'}
OF_FRAME = {'frame.c', 'replay.c', 'ortho.c', 'panel.c', 'spectrum.c', 'blocks.c', 'blas.c'}
OF_MODES = {'fields.c', 'harmonics.c', 'modes.c'}
OF_STEPS = {'steps.c', 'sets.c'}
OF_PHASES = {'phases.c', 'rotor.c'}
OF_STRUCTURE = {'structure.c'}
OF_GAS, OF_WIDTHS = {'gas.c'}, {'localization.c'}
OF_CALLER = {'pmode.c', 'hydro.c', 'dispersion.c'}  # called by who publishes
LATER = OF_MODES | OF_STEPS | OF_PHASES | OF_STRUCTURE | OF_CALLER | OF_GAS | OF_WIDTHS
LIBRARIES = ('blas', 'lapack', 'gomp')


@functools.lru_cache(maxsize=None)
def profiles(scene):
    return callgrind.profiles(VALGRIND, LOAD, dict(scene))


def profile(*parts, **scene):
    """Of these parts of a run together, or of the whole."""
    whole = callgrind.Profile()
    for part in parts or callgrind.PARTS:
        whole.add(profiles(tuple(sorted(scene.items())))[part])
    return whole


def libraries(of):
    return {part for part in LIBRARIES if any(part in name for name in of.objects)}


def of_function(of, file, function):
    lines = callgrind.body(os.path.join(CORE, 'src', file), function)
    return of.of_lines(os.path.basename(file), *lines)


class Stages(unittest.TestCase):
    """A stage that is not asked for executes nothing; each test sees it work where it is asked
    for."""

    def test_trajectory_alone(self):
        for scene in (dict(), dict(x=1, y=1)):
            alone = profile(exponents=NONE, **scene)
            self.assertLessEqual(OF_TRAJECTORY, alone.files())
            self.assertEqual(alone.files() & (OF_FRAME | {'event_log.c'} | LATER), set())
            self.assertEqual(libraries(alone), set())

    def test_spectrum_alone(self):
        for exponents in (1, POSITIVE, ALL):
            spectrum = profile(exponents=exponents)
            self.assertLessEqual(OF_FRAME, spectrum.files())
            self.assertEqual(libraries(spectrum), set(LIBRARIES))
            self.assertEqual(spectrum.files() & LATER, set())

    def test_steps_alone(self):
        for observe in (MODES, STEPS):
            steps = profile(observe=observe, look=observe)
            self.assertLessEqual(OF_MODES | OF_STEPS, steps.files())
            self.assertEqual(steps.files() & (OF_PHASES | OF_CALLER), set())

    def test_everything(self):
        everything = profile('average', observe=EVERYTHING, look=EVERYTHING)
        self.assertEqual(LATER - everything.files(), OF_CALLER | OF_GAS | OF_WIDTHS)

    def test_nobody_looks(self):
        unseen = profile('average', observe=EVERYTHING, look=0)
        self.assertLessEqual(OF_FRAME, unseen.files())
        self.assertEqual(unseen.files() & LATER, set())

    def test_gas(self):
        """Needs no frame, and costs next to nothing."""
        gas = profile('average', exponents=NONE, observe=GAS)
        self.assertLessEqual(OF_TRAJECTORY | OF_GAS, gas.files())
        self.assertEqual(gas.files() & (OF_FRAME | LATER), OF_GAS | {'blocks.c'})
        spent = gas.of_file('gas.c') + gas.of_file('blocks.c')
        self.assertLess(spent, 0.01 * sum(map(gas.of_file, OF_TRAJECTORY)))

    def test_widths(self):
        seen = profile('average', observe=WIDTHS, look=WIDTHS)
        self.assertEqual(seen.files() & LATER, OF_WIDTHS)
        unseen = profile('average', observe=WIDTHS, look=0)
        self.assertEqual(unseen.files() & LATER, set())

    def test_equilibration_has_no_frame(self):
        with_frame = profile('equilibrate')
        self.assertLessEqual(OF_TRAJECTORY, with_frame.files())
        self.assertEqual(with_frame.files() & (OF_FRAME | LATER), set())
        alone = profile('equilibrate', exponents=NONE)
        for file in OF_TRAJECTORY - {'trajectory.c'}:
            self.assertEqual(with_frame.of_file(file), alone.of_file(file), file)
        for function in ('hd_trajectory_extend', 'take_event', 'collide'):
            place = ('events/trajectory.c', function)
            self.assertEqual(of_function(with_frame, *place), of_function(alone, *place), function)


class Walls(unittest.TestCase):
    PLACES = (('events/trajectory.c', 'reflect'), ('tangent/replay.c', 'reflect'))

    def test_without_walls_nothing_is_reflected(self):
        for place in self.PLACES:
            self.assertEqual(of_function(profile(), *place), 0, place)
            for x, y in ((0, 1), (1, 0), (1, 1)):
                self.assertGreater(of_function(profile(x=x, y=y), *place), 1000, place)


class Vectors(unittest.TestCase):
    """The replay's instructions for as many vectors as are asked for; columns come in eights."""

    DISKS = 40  # the positive half: 77 vectors

    def replay(self, exponents):
        spent = profile('average', disks=self.DISKS, time=2.0, exponents=exponents)
        return spent.of_file('replay.c')

    def test_ten_vectors(self):
        of_column = (self.replay(32) - self.replay(16)) / 16
        without = self.replay(16) - 16 * of_column  # the maps: the same for any number
        self.assertGreater(without, 0)
        self.assertEqual(self.replay(10), self.replay(16))
        half = self.replay(POSITIVE)
        self.assertLess(self.replay(10), 0.3 * half)

    def test_one_vector(self):
        of_column = (self.replay(32) - self.replay(16)) / 16
        without = self.replay(16) - 16 * of_column
        self.assertLess(self.replay(1) - without, 3 * of_column)

    def test_trajectory_does_not_know(self):
        one, ten = (profile('average', disks=self.DISKS, time=2.0, exponents=n) for n in (1, 10))
        for file in OF_TRAJECTORY:
            self.assertEqual(one.of_file(file), ten.of_file(file), file)


class Loop(unittest.TestCase):
    """After its first steps no part of a run asks for memory; libraries for linear algebra and
    threads do."""

    def test_nothing_is_allocated(self):
        for scene in (
            dict(exponents=NONE),
            dict(exponents=10),
            dict(),
            dict(x=1, y=1),
            dict(observe=EVERYTHING, look=EVERYTHING),
        ):
            self.assertEqual(profile('average', **scene).calls['hd_memory_alloc'], 0, scene)
            self.assertGreater(profile('create', **scene).calls['hd_memory_alloc'], 5, scene)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
