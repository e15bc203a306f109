"""What the studies share: their tables, a fit, colours and style."""

import csv
import importlib.util
import os
import sys

import numpy as np

ROOT = os.path.join(os.path.dirname(__file__), '../..')
# the package's colours, beside this file or installed; all of it would need ROS
INSTALLED = importlib.util.find_spec('hdlyap')
PACKAGES = INSTALLED.submodule_search_locations if INSTALLED else []
for package in [os.path.join(ROOT, 'hdlyap_ros/python/hdlyap'), *PACKAGES]:
    sys.path.append(os.path.join(package, 'plots/figures'))
from look import BLUE, GREEN, GREY, INK, ORANGE, PLAIN, SKY, VERMILION  # noqa: E402, F401

# by density
COLOURS = {0.1: SKY, 0.2: BLUE, 0.4: GREEN, 0.6: ORANGE, 0.8: VERMILION}
RATE = 'P_xx / (sqrt(2) rho)'  # of the rotation over k, as the pressure has it
BAR = 3  # standard errors
WORDS = (
    'ends of x',
    'boundaries',
    'kind',
    'inertia',
    'potential',
    'integrator',
    'particles',
    'part',
    'shape',
    'quantity',
)  # columns of them


def rows_of(path):
    """Columns by their names, without the units."""
    with open(path, encoding='utf-8') as file:
        rows = csv.reader(line for line in file if not line.startswith('#'))
        names = [name.partition(' [')[0] for name in next(rows)]
        return [
            {name: text if name in WORDS else float(text) for name, text in zip(names, row)}
            for row in rows
        ]


def fit(values, errors, *columns):
    """Weighted least squares: coefficients, their errors, chi^2, degrees of freedom."""
    weight = 1 / np.array(errors)
    matrix = np.transpose(columns) * weight[:, None]
    inverse = np.linalg.inv(matrix.T @ matrix)
    found = inverse @ matrix.T @ (values * weight)
    chi2 = np.sum((values * weight - matrix @ found) ** 2)
    return found, np.sqrt(np.diag(inverse)), chi2, len(values) - len(found)


def told(title, found, errors, chi2, freedom):
    """One line of a fit."""
    numbers = '  '.join(f'{one:.4f} +- {error:.4f}' for one, error in zip(found, errors))
    return f'{title}: {numbers}  chi^2 {chi2:.1f} for {freedom}'
