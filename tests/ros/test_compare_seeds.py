"""compare of several seeds a side: the scatter over seeds counts where it is larger than the stated
error, for every quantity."""

import copy
import unittest
from math import hypot, sqrt
from types import SimpleNamespace

import numpy as np
import pandas

import hdlyap
import made
import trials
from test_compare import EXPONENTS, Pairs, run
from hdlyap.data.summary import Summary
from hdlyap.data.seeds import Seeds
from hdlyap.plots import verdict
from hdlyap.plots.comparison import Comparison
from hdlyap.plots.deviation import FREEDOM

GAS = 'collision rate', 'pressure', 'pressure x', 'pressure y', 'compressibility'
SOFT_GAS = *GAS[1:], 'temperature', 'potential energy'
SCATTER = np.array([-1.0, 0.0, 1.0])  # of three seeds: their mean is known to 1 / sqrt(3)


class ThreeSeeds(Pairs):
    def sides(self, off=0.0, make=made.soft_gas, names=('pressure',), each=0.1, **fields):
        """Of two sides; quantities of the gas scatter by `each`, those of b are larger by off."""
        found = []
        for side, more in (('a', 0.0), ('b', off)):
            paths = []
            for number, place in enumerate(SCATTER):
                exponents = EXPONENTS + each * place + 1e-6 * (side == 'b')
                of = {'run_id': f'{side}{number}', 'seed': f'{number}{"ab".index(side)}'}
                gas = make(run_id=of['run_id'], **fields)
                for name in names:
                    setattr(gas, name, getattr(gas, name) + more + each * place)
                paths.append(self.write([*run(exponents, **of), gas], of['run_id']))
            found.append(hdlyap.load(*paths).summary)
        return found

    def of_gas(self, comparison):
        return {one.name: one for one in comparison.gas}

    def test_all_of_the_gas_is_judged(self):
        flow = 'shear stress', 'velocity low', 'velocity high', 'divergence'
        of_shear = made.shear_gas, (*GAS, *flow)
        for make, names in ((made.gas, GAS), (made.soft_gas, SOFT_GAS), of_shear):
            found = self.of_gas(Comparison(*self.sides(make=make)))
            self.assertEqual(tuple(found), names)
            self.assertTrue(all(one.judged and one.is_known for one in found.values()))

    def test_the_divergence_counts_once(self):
        """It is the sum of all exponents, where these are compared."""
        for exponent_sum, there in ((-0.25, False), (np.nan, True)):
            gas = [(side, made.shear_gas(run_id=side), exponent_sum) for side in 'ab']
            comparison = Comparison(*(self.load_of(*one) for one in gas))
            self.assertEqual('exponent_sum' in [one.name for one in comparison.sums], not there)
            self.assertEqual('divergence' in self.of_gas(comparison), there)
            self.assertIn('shear stress', self.of_gas(comparison))

    def test_averages_are_judged(self):
        """What both sides tell."""
        sides = [
            self.load_of(side, made.averages(run_id=side, kinetic=kinetic, **{side: 1.0}))
            for side, kinetic in (('a', 1.0), ('b', 1.1))
        ]
        (one,) = Comparison(*sides).gas
        self.assertEqual((one.name, *one.values), ('kinetic', 1.0, 1.1))
        self.assertAlmostEqual(abs(one.z), 0.1 / hypot(0.01, 0.01), 9)

    def load_of(self, side, message, exponent_sum=np.nan):
        messages = [*run(EXPONENTS, run_id=side, seed=f'{"ab".index(side)}'), message]
        messages[2].exponent_sum = exponent_sum
        return hdlyap.load(self.write(messages, side)).summary

    def test_the_larger_error_counts(self):
        for each, expected in ((0.1, 0.1 / sqrt(3)), (0.001, 0.01 / sqrt(3))):
            comparison = Comparison(*self.sides(off=0.2, each=each))
            one = self.of_gas(comparison)['pressure']
            np.testing.assert_allclose(one.errors, [expected] * 2, rtol=1e-9)
            self.assertAlmostEqual(one.z, 0.2 / hypot(*one.errors), 9)
            self.assertIn(f'{one.z:+.2f}', verdict.report(comparison))

    def test_the_scatter_of_three_has_two_degrees_of_freedom(self):
        """Of four for the difference: 2 (1 - F(z)) of Student's t = 1 - u (3 - u^2) / 2 there, u =
        z / sqrt(4 + z^2)."""
        for error in (1e-6, -1.0):  # nothing stated counts
            one = self.of_gas(Comparison(*self.sides(off=0.3, error=error)))['pressure']
            self.assertAlmostEqual(one.error, 0.1 * sqrt(2 / 3), 9)
            u = one.z / sqrt(4 + one.z**2)
            self.assertAlmostEqual(one.chance, 1 - 0.5 * u * (3 - u * u), 6)
        self.assertLess(2, FREEDOM)

    def test_errors_that_are_stated_by_none(self):
        """Are those of the scatter, whose chance says how few the runs are."""
        comparison = Comparison(*self.sides(off=20.0, error=-1.0))
        self.assertTrue(all(one.is_known for one in comparison.gas if one.name == 'pressure'))
        self.assertEqual(verdict.verdict(comparison)[1], verdict.DIFFER)

    def test_brackets_add_up(self):
        comparison = Comparison(*self.sides())
        text = verdict.report(comparison)
        for one in comparison.deviations:
            if not one.is_joint and one.is_known:
                self.assertAlmostEqual(one.error, hypot(*one.errors), 12)
        said = [line for line in text.splitlines() if line.startswith('  h_KS')]
        of_both = comparison.sums[0]
        self.assertEqual('of both' in said[0], of_both.is_joint and of_both.error > 0)


class World(trials.World):
    """Whose seeds scatter `factor` times as much as their errors say: all exponents together, and
    what a gas has."""

    factor = 1.0

    def of_seeds(self, blocks, seeds):
        return Summary(Seeds([self.one(blocks, str(seed)) for seed in range(seeds)]))

    def one(self, blocks, seed):
        samples = self.run(blocks)
        of_sum = samples.sum(axis=1).std() / sqrt(blocks)
        beyond = sqrt(max(self.factor**2 - 1, 0.0)) * self.random.normal()
        said = self.said([samples], beyond * of_sum / self.count)
        time, names = said.spectrum.averaged_time, ['lambda_max', 'h_KS']
        numbers = {'spectrum': said.spectrum, 'gas': made.gas(time)}
        value = 0.01 * self.factor * self.random.normal(size=2)
        numbers['gas'].collision_rate, numbers['gas'].pressure = value
        errors = [said.spectrum.std_errors[0], said.sum_error]
        results = {
            'value': [said.spectrum.exponents[0], said.spectrum.ks_entropy],
            'std_error': errors, 'sampling_error': errors, 'misfit': np.nan,
            'unit': '', 'basis': '',
        }  # fmt: skip
        spectrum = {'exponent': said.spectrum.exponents, 'std_error': said.spectrum.std_errors}
        of_gas = {'value': value, 'std_error': 0.01, 'unit': ''}
        return SimpleNamespace(
            info=copy.copy(self.info), paths=[seed], fits=[], averaged_times=[time],
            spectrum=pandas.DataFrame(spectrum, pandas.RangeIndex(1, self.count + 1)),
            results=pandas.DataFrame(results, names), local=said.data.runs[0].local,
            gas=pandas.DataFrame(of_gas, ['collision_rate', 'pressure']),
            has=lambda topic: topic in numbers,
            last=lambda topic, numpy=None: copy.copy(numbers[topic]),
        )  # fmt: skip


def differ(world, seeds, blocks=30, trials=120):
    """(part of the pairs that are said to differ, and whose h_KS is below its chance of 1 %)"""
    pairs = [[world.of_seeds(blocks, seeds) for _ in 'ab'] for _ in range(trials)]
    found = [Comparison(*pair) for pair in pairs]
    status = [verdict.verdict(one)[1] == verdict.DIFFER for one in found]
    return np.mean(status), np.mean([one.sums[0].chance < 0.01 for one in found])


class FalseAlarms(unittest.TestCase):
    def test_of_seeds_that_scatter_more_than_they_say(self):
        """Of 120 pairs of one system 2 % may be said to differ, and 1 % have a chance of 1 %: by
        chance not more than 5.8 % and 3.7 % (three standard errors)."""
        for factor, seeds in ((1.0, 3), (3.0, 3), (3.0, 6)):
            world = World(20)
            world.factor = factor
            found = differ(world, seeds)
            with self.subTest(factor=factor, seeds=seeds, found=found):
                self.assertLessEqual(found[0], 0.058)
                self.assertLessEqual(found[1], 0.037)
