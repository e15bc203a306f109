"""How often compare says that made-up runs differ: of one system, and with a planted difference.

trials.py [COUNT] prints the table of it. The exponents of a run fluctuate from block to block
together with their neighbours and a little all at once; errors are those of the blocks."""

import sys
from types import SimpleNamespace

import numpy as np

import made
from made import LP, T
from hdlyap.data.run import Local
from hdlyap.plots import verdict
from hdlyap.plots.comparison import Comparison

NEIGHBOURS = 0.6  # their correlation
ALL = 0.1  # part of the variance that all have in common
LENGTH = 5.0  # of a block
MOST_STEPS = 6


class World:
    """Of so many exponents, the last ones of which are in steps."""

    def __init__(self, exponents, seed=1):
        self.count, self.random = exponents, np.random.default_rng(seed)
        self.info = made.run_info(number=(exponents + 3) // 2)
        self.mean = np.linspace(6.0, 0.3, exponents)
        self.sigma = 0.3 * np.sqrt(self.mean)
        self.steps, end = [], exponents
        for n in range(1, MOST_STEPS // 2 + 1):
            for kind, size in ((T, 2), (LP, 4)):
                if end - size > exponents // 3:
                    self.steps.append((kind, n, end - size, end))
                    end -= size

    def run(self, blocks):
        noise = self.random.normal(size=(blocks, self.count))
        for column in range(1, self.count):
            noise[:, column] *= np.sqrt(1 - NEIGHBOURS**2)
            noise[:, column] += NEIGHBOURS * noise[:, column - 1]
        noise = np.sqrt(1 - ALL) * noise + np.sqrt(ALL) * self.random.normal(size=(blocks, 1))
        return self.mean + self.sigma * noise

    def said(self, samples, shift=0.0):
        """As data.summary of runs with these samples, all of whose exponents are shifted."""
        all_of = np.concatenate(samples)
        count = len(all_of)
        deviations = np.concatenate([one - one.mean(axis=0) for one in samples])
        values = all_of.mean(axis=0) + shift

        def error(of):
            return float(np.sqrt((of**2).sum() / (count - len(samples)) / count))

        spectrum = made.spectrum(values, count * LENGTH)
        spectrum.std_errors = [error(column) for column in deviations.T]
        positive = slice(0, self.count)
        spectrum.ks_entropy = values[positive].sum()
        spectrum.ks_entropy_error = error(deviations[:, positive].sum(axis=1))
        steps = [
            made.step(
                self.info, kind, n, 0, first + 1, end,
                exponent=values[first:end].mean(),
                std_error=error(deviations[:, first:end].mean(axis=1)),
            )
            for kind, n, first, end in self.steps
        ]  # fmt: skip
        message = made.steps(steps)
        message.t_points = message.l_points = message.v_phases = 0
        runs = [
            SimpleNamespace(local=_local(one + shift), has=lambda topic: False) for one in samples
        ]
        return SimpleNamespace(
            info=self.info, is_mean=False, spectrum=spectrum, steps=message, left_out=(),
            positive_end=self.count, zeros=range(0), last_index=len(values), sum_name='h_KS',
            sum_error=spectrum.ks_entropy_error, data=SimpleNamespace(runs=runs),
        )  # fmt: skip

    def differ(self, blocks, seeds, planted):
        """Whether two such runs (of several seeds each) are said to differ."""
        a, b = ([self.run(blocks) for _ in range(seeds)] for _ in 'ab')
        one, other = self.said(a), self.said(b)
        if planted:
            other = self.said(b, planted(self, one, other))
        return verdict.verdict(Comparison(one, other))[1] == verdict.DIFFER


def _local(samples):
    lengths = np.full(len(samples), LENGTH)
    return Local(np.cumsum(lengths), lengths, samples)


def all_by_three(world, one, other):
    return 3 * np.hypot(one.spectrum.std_errors, other.spectrum.std_errors)


def a_step_by_five(world, one, other):
    chosen = world.random.integers(len(world.steps))
    _, _, first, end = world.steps[chosen]
    errors = [run.steps.steps[chosen].std_error for run in (one, other)]
    shift = np.zeros(world.count)
    shift[first:end] = 5 * np.hypot(*errors)
    return shift


PLANTED = {'nothing': None, 'all by 3 errors': all_by_three, 'a step by 5 errors': a_step_by_five}


def share(exponents, blocks, seeds, planted, trials, seed=1):
    world = World(exponents, seed)
    return sum(world.differ(blocks, seeds, planted) for _ in range(trials)) / trials


if __name__ == '__main__':
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    print('exponents  blocks  seeds  ' + '  '.join(PLANTED))
    for case in (
        (20, 10, 1),
        (20, 30, 1),
        (20, 100, 1),
        (197, 10, 1),
        (197, 30, 1),
        (197, 100, 1),
        (197, 10, 3),
        (1557, 16, 1),
        (1557, 100, 1),
    ):
        found = (100 * share(*case, planted, trials) for planted in PLANTED.values())
        print(
            '{:>9}  {:>6}  {:>5}  '.format(*case) + '  '.join(f'{one:.3g} %' for one in found),
            flush=True,
        )
