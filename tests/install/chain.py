#!/usr/bin/python3
"""chain.py BAG BAG: a chain that a user's node has moved, and the run that went on from its end."""

import sys

import hdlyap
import rosbag
from hdlyap.plots import report
from hdlyap.plots.figures import style
import numpy as np


def main():
    one, two = (hdlyap.load(path) for path in sys.argv[1:])
    assert one.info.particles == 'chain' and one.info.dimension == 0, one.info
    own = {'beta': 2, 'energy': 1, 'time_step': 0.03125, 'integrator': 'pefrl'}  # chosen
    assert one.own == own, one.own
    said = ', '.join(f'{name}={value}' for name, value in own.items())
    assert report.system(one.info) == f'chain, N = 8, {said}'
    assert style.scene(one.info) == 'ring: chain, $N=8$'
    assert (one.summary.phase_space, one.summary.positive_end) == (16, 6)
    with rosbag.Bag(sys.argv[1]) as bag:
        said = [
            status.message
            for _, heard, _ in bag.read_messages('/diagnostics')
            for status in heard.status
        ]
    assert len(said) >= 4 and not any('energy' in text or 'overlap' in text for text in said), said
    assert two.own == one.own and two.info.resumed_time > 0
    assert two.is_complete and two.times[-1] > 1.5 * one.times[-1]
    exponents = two.exponents[-1]
    assert len(exponents) == 16 and 0.05 < exponents[0] < 0.5, exponents
    assert np.abs(exponents + exponents[::-1]).max() < 1e-7, 'pairs'
    zeros = np.abs(exponents) < 0.1 * exponents[5]
    assert zeros.sum() == 4 and list(np.flatnonzero(zeros)) == [6, 7, 8, 9], exponents


main()
