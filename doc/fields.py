#!/usr/bin/python3
"""The T, L and P field of A = cos k x at the disks of a box that is periodic along x.
fields.py FIGURE.png BAG..."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import hdlyap

run = hdlyap.load(*sys.argv[2:])
time = run.times[-1]
q, p = run.state.positions(time), run.state.momenta(time)
k = 2 * np.pi / run.info.box_x
wave = np.cos(k * q[:, :1])
gradient = np.column_stack((-k * np.sin(k * q[:, 0]), np.zeros(len(q))))
fields = {
    'T = curl A: across the wave, (0, k sin kx)': (gradient[:, ::-1] * (1, -1), 'tab:blue'),
    'L = grad A: along the wave, (-k sin kx, 0)': (gradient, 'tab:orange'),
    'P = p A: along the momentum of each disk, p cos kx': (p * wave, 'tab:red'),
}
figure, axes = plt.subplots(3, 1, figsize=(9, 6.5), sharex=True, constrained_layout=True)
for axis, (title, (field, colour)) in zip(axes, fields.items()):
    arrows = 0.9 * field / np.sqrt(np.mean(field**2) * 2)
    for centre in q:
        axis.add_patch(plt.Circle(centre, 0.5, fill=False, color='0.8'))
    axis.quiver(*q.T, *arrows.T, color=colour, angles='xy', scale_units='xy', scale=1, width=0.0025)
    axis.set(xlim=(0, run.info.box_x), ylim=(0, run.info.box_y), aspect='equal', ylabel='y [sigma]')
    axis.set_title(title)
axes[-1].set_xlabel('x [sigma]')
figure.savefig(sys.argv[1], dpi=100)
