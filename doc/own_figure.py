#!/usr/bin/python3
"""A figure of one's own: the spectrum with its errors, and how the local largest exponent is
distributed. own_figure.py FIGURE.png BAG..."""

import sys

import matplotlib.pyplot as plt

import hdlyap

run = hdlyap.load(*sys.argv[2:])
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), constrained_layout=True)
left.errorbar(run.spectrum.index, run.spectrum.exponent, run.spectrum.std_error, fmt='.')
left.set_xlabel('Lyapunov index')
left.set_ylabel('exponent [%s]' % run.units['exponents'])
right.hist(run.local.exponents[:, 0], bins=20)  # each sample once
right.axvline(run.results.value['lambda_max'], color='black')
right.set_xlabel('local lambda_max [%s]' % run.units['local.exponents'])
figure.suptitle('%s: %d disks' % (run.info.scene, run.info.number))
figure.savefig(sys.argv[1])
