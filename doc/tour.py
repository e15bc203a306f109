#!/usr/bin/python3
"""From the spectrum over the phases of an LP mode to covariant vectors: doc/tour.md.
tour.py FOLDER BAG..."""

import os
import sys

import matplotlib.pyplot as plt
import numpy as np

import hdlyap
from hdlyap.msg import Step

folder = sys.argv[1]
run = hdlyap.load(*sys.argv[2:])
steps = run.steps[run.steps.resolved & (run.steps.kind != 'zero')]
os.makedirs(folder, exist_ok=True)


def save(figure, name):
    figure.suptitle('%d disks, density %g' % (run.info.number, run.info.density))
    figure.savefig(os.path.join(folder, name + '.png'), dpi=150)


# 1. The spectrum; the steps of its smallest exponents against their wave numbers.
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), constrained_layout=True)
left.plot(run.spectrum.index, run.spectrum.exponent, '.')
left.set_xlabel('Lyapunov index')
left.set_ylabel('exponent [%s]' % run.units['exponents'])
right.errorbar(steps.wave_number, steps.exponent, steps.std_error, fmt='ko')
for name, step in steps.iterrows():
    right.annotate(
        name, (step.wave_number, step.exponent), xytext=(6, -8), textcoords='offset points'
    )
for slope, colour in (('c_T', 'tab:blue'), ('c_L', 'tab:red')):
    value, error = run.results.loc[slope, ['value', 'std_error']]
    right.axline(
        (0, 0),
        slope=value,
        color=colour,
        linewidth=0.7,
        label='%s = %.2f +- %.2f' % (slope, value, error),
    )
right.set(xlim=(0, 0.6), ylim=(0, 2), xlabel='k [1/sigma]')
right.legend()
save(figure, 'tour_spectrum')

# 2. The coefficients (a, b) of one LP pair go round; their phase grows as omega t.
course = run.course('lp_phases').xs(0, level='number')
time = course.index.get_level_values('sim_time')
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), constrained_layout=True)
states = course[['a', 'b']].drop_duplicates().iloc[-33:]  # two reports may tell of the same state
left.plot(states.a, states.b, 'o-', linewidth=0.5, markersize=3)
left.set(
    xlim=(-1, 1),
    ylim=(-1, 1),
    aspect='equal',
    xlabel='a, of the L field',
    ylabel='b, of the P field',
)
right.plot(time, course.phase / (2 * np.pi))
first = run.phases.loc[0]
right.set(xlabel='simulated time', ylabel='phase / 2 pi')
right.set_title('%s: omega = %.3f +- %.3f' % (first.step, first.omega, first.omega_error))
save(figure, 'tour_phases')

# 3. Covariant vectors: how much of them is a mode, and how far apart are the spaces that they span?
last = list(run.messages('covariant'))[-1]
lowest = steps.iloc[0]
(weight,) = [
    one for one in last.weights if (one.kind, one.nx, one.ny) == (Step.T, lowest.nx, lowest.ny)
]
index = last.first_index + np.arange(len(weight.dq))
near = abs(index - lowest.last_index) < 20
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), constrained_layout=True)
for values, marker, name in (
    (weight.gram_schmidt, 'o', 'Gram-Schmidt, dq'),
    (weight.dq, 's', 'covariant, dq'),
    (weight.dp, '^', 'covariant, dp'),
):
    left.plot(index[near], np.array(values)[near], marker, label=name, fillstyle='none')
left.set(xlabel='Lyapunov index', ylabel='weight in the fields of %s' % lowest.name)
left.legend(loc='center left')
(angle,) = [one for one in last.angles if one.spaces == one.UNSTABLE_STABLE]
counts = np.array(angle.smallest_counts, dtype=float)
right.stairs(counts / counts.sum(), np.linspace(0, np.pi / 2, len(counts) + 1), fill=True)
right.set(
    xlabel='smallest angle between unstable and stable space [rad]', ylabel='part of the samples'
)
right.set_title('mean %.3f rad, least %.3f' % (angle.mean, angle.least))
save(figure, 'tour_covariant')
