#!/usr/bin/python3
"""A page to copy cell by cell into a notebook: figures in axes of one's own, all of a run as one
xarray.Dataset, and how many of its samples are independent. own_analysis.py FIGURE.png BAG..."""

# %% A recorded run; what it measured, with standard errors
import os
import sys

import matplotlib.pyplot as plt

import hdlyap
from hdlyap.data import series
from hdlyap.plots.figures import blocks, dispersion, spectrum

run = hdlyap.load(*sys.argv[2:])
print(run)
print(run.results[['value', 'std_error', 'unit']])

# %% Figures of hdlyap plot, in axes and colours of one's own
figure, axes = plt.subplots(2, 2, figsize=(10, 8), constrained_layout=True)
spectrum.draw(run, ax=axes[0, 0], color='tab:green', markersize=3)
dispersion.draw(run, ax=axes[0, 1])  # None, and the axes empty, if no step was found

# %% Everything with names, units and dimensions; netCDF keeps it
data = run.to_xarray()
print(data['exponents'].attrs, dict(data.sizes))
print(data['steps_exponent'].isel(time=-1).to_series().dropna())
data.to_netcdf(os.path.splitext(sys.argv[1])[0] + '.nc')

# %% How long the largest local exponent remembers
samples, lengths = run.local.exponents[:, 0], run.local.lengths
rho = series.autocorrelation(samples)[:20]
axes[1, 0].stem(rho)
axes[1, 0].set(xlabel='samples apart', ylabel='autocorrelation of $\\lambda_1$')
independent = series.effective_samples(samples)
print('%d samples, as good as %.0f independent ones' % (len(samples), independent))

# %% The error that the node has stated, checked in three lines
error, stated = series.standard_error(samples, lengths), run.std_errors[-1, 0]
print('lambda_max +- %.2g by the samples, +- %.2g by the node' % (error, stated))
blocks.draw(samples, lengths, stated=stated, ax=axes[1, 1])

# %% Kept
figure.suptitle('%s: %d %ss' % (run.info.scene, run.info.number, run.info.particles.rstrip('s')))
figure.savefig(sys.argv[1])
