"""Bags -> points. A point is a system with means over its seeds, or the numbers of a single run."""

import os
from collections import namedtuple

import numpy as np

from hdlyap.data import reader, seeds, space
from hdlyap.data import joined
from hdlyap.data.run import OF_ALL
from hdlyap.parameters import asked_of_own, named, value
from hdlyap.data.reader import RecordingError
from hdlyap.data.containers import is_curved, radius

# name in a frame of results -> its unit; in the order of columns of a table
QUANTITIES = {
    'lambda_max': '1/time unit',
    'h_KS/N': '1/time unit',
    'c_T': 'sigma/time unit',
    'c_L': 'sigma/time unit',
    'v': 'sigma/time unit',
    'collision_rate': '1/time unit',
    'pressure': '1/sigma^2',
    'temperature': 'epsilon',
    **OF_ALL,
    'shear_stress': '1/sigma^2',
    'velocity_low': 'sigma/time unit',
    'velocity_high': 'sigma/time unit',
}
GAS = ('collision_rate', 'pressure', 'temperature', 'shear_stress', 'velocity_low', 'velocity_high')
FITTED = ('c_T', 'c_L', 'v')
NAN = float('nan')


class Value(namedtuple('Value', 'value std_error scatter chi2 runs misfit fit')):
    """A mean over runs. std_error follows from the errors that the runs state, scatter from the
    scatter of runs; they are NaN if not known, as is the misfit. fit: the data.fits.Fit that gave
    it, or None."""

    @property
    def error(self):
        """The larger one of the two errors; the known one if the other is not known."""
        return float(np.fmax(self.std_error, self.scatter))


class Point:
    """The runs of one system."""

    def __init__(self, paths, choice=(None, None), remarks=(), run='', own=()):
        """remarks: lines about the bags; run: the name of its runs in a plan; own: as of system.
        Raises RecordingError if the bags have no averages or do not belong together."""
        self.remarks, self.run = remarks, run
        self.data = seeds.load(*paths, form=choice[0], k=choice[1])
        self.runs = self.data.runs
        self.system = system(self.data.info, own)
        self.values = self._values()  # {quantity: Value} of the quantities that were measured

    def _values(self):
        """{quantity: Value}. h_KS is missing if a run has not all positive exponents."""
        frame = self.data.results
        found = {'lambda_max': self._value(frame.loc['lambda_max'])}
        if 'h_KS' in frame.index:
            found['h_KS/N'] = self._value(frame.loc['h_KS'], 1 / self.data.info.number)
        for name in OF_ALL:
            if name in frame.index:
                found[name] = self._value(frame.loc[name])
        for fit in self.runs[0].fits:
            if fit.symbol in frame.index:
                found[fit.symbol] = self._value(frame.loc[fit.symbol], fit=fit)
        if self.data.has('gas'):
            gas = self.data.gas
            found.update((name, self._value(gas.loc[name])) for name in GAS if name in gas.index)
        if self.data.has('averages'):
            rows = self.data.averages.iterrows()
            found.update((name, self._value(row)) for name, row in rows)
        return found

    @staticmethod
    def _value(row, factor=1.0, fit=None):
        """The Value in a row. A single run has no scatter."""
        names = 'value', 'std_error', 'scatter'
        scaled = (float(row.get(name, NAN)) * factor for name in names)
        chi2, misfit = float(row.get('chi2', NAN)), float(row.get('misfit', NAN))
        return Value(*scaled, chi2, int(row.get('runs', 1)), misfit, fit)

    @property
    def warnings(self):
        """A line for each run that is less good than it looks."""
        yield from (line for run in self.runs for line in run.summary.warnings())

    @property
    def energy_error(self):
        """The largest relative error of the energy of a run; None of particles without time
        steps."""
        found = [run.summary.energy_error for run in self.runs]
        return max((one for one in found if one is not None), default=None)

    @property
    def unlike(self):
        """Quantities whose fits have different forms or wave numbers for different seeds."""
        found = {fit.symbol for run in self.runs for fit in run.fits}
        return [name for name in FITTED if name in found and name not in self.values]


def system(info, own):
    """own: names of the parameters that only these particles have and that mean something in one of
    the systems, as a second kind in one of disks."""
    found = [named(info, name) for name in own]
    asked = {one.name: value(one, one.value) for one in found if one}  # an older program has fewer
    if space.without_box(info):
        return {'number': info.number, **asked}
    walls = [info.container] if is_curved(info) else space.along(info, 'boundary_')
    walls = walls[:1] if len(set(walls)) == 1 else walls
    solid = {'aspect_z': info.aspect_z} if space.is_solid(info) else {}
    sheared = {'shear_b': info.shear_b} if 'shearing' in walls else {}
    return {
        'number': info.number,
        'density': info.density,
        'aspect': '' if radius(info) else info.aspect,  # a circle has none
        **solid,
        **asked,
        'boundary': ','.join(walls),
        **sheared,
    }


def varied(points):
    """Names of parameters that differ between points, and {name: value} of those that do not and
    that these systems have."""
    values = {name: {point.system[name] for point in points} for name in points[0].system}
    differ = [name for name, found in values.items() if len(found) > 1]
    fixed = {name: found.pop() for name, found in values.items() if name not in differ}
    return differ, {name: value for name, value in fixed.items() if value != ''}


def quantities(points):
    """{name: unit} of what points can have, in the order of columns of a table: last what particles
    of a program's own tell."""
    found = {name: space.unit(unit, points[0].data.info) for name, unit in QUANTITIES.items()}
    for point in points:
        if point.data.has('averages'):
            found.update(point.data.averages['unit'])
    return found


def _numbers_first(found):
    return [(isinstance(value, str), value) for value in found[0]]


def read(paths, choice=(None, None), is_plan=False):
    """Returns points, sorted by their systems, and a line for each bag or system that cannot be
    read. Points of a plan have the names of their runs; runs of one system that have no mean are a
    point each."""
    infos, systems, wrong, first, counts = {}, {}, [], None, {}
    for path in paths:
        try:
            found = list(reader.run_infos(path).values())
            info, counts[path] = found[-1], len(found)
            first = first or info
            if info.particles != first.particles:
                what, others = info.particles, first.particles
                raise RecordingError(f'{path}: particles = {what}, but this table is of {others}')
            infos[path] = info
        except RecordingError as error:
            wrong.append(str(error))
    own = dict.fromkeys(name for info in infos.values() for name in asked_of_own(info))
    for path, info in infos.items():
        same = [str(getattr(info, name)) for name in joined.compared(info)]
        systems.setdefault((*system(info, own).values(), *same), []).append(path)
    points = []
    for _, of_one in sorted(systems.items(), key=_numbers_first):
        try:
            of_several = [path for path in of_one if counts[path] > 1]
            remarks = [f'{path}: the last of its {counts[path]} runs' for path in of_several]
            name = _name(of_one) if is_plan else ''
            points.append(Point(of_one, choice, remarks, name, own))
        except RecordingError as error:
            if is_plan and len(of_one) > 1:
                points += [Point([path], choice, remarks, _name([path]), own) for path in of_one]
            else:
                wrong.append(str(error))
    names = dict.fromkeys(name for point in points for name in point.system)
    for point in points:  # walls of some shear
        point.system = {name: point.system.get(name, '') for name in names}
    return points, wrong


def _name(paths):
    """The names of these bags, without folder and ending."""
    return ' '.join(os.path.splitext(os.path.basename(path))[0] for path in paths)
