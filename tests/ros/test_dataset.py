"""run.to_xarray(): what was recorded, by names of dimensions, with units and words of messages."""

import json
import os
import re
import sys
from unittest import mock

import numpy as np
import xarray
from hdlyap.msg import Change, Hydro, HydroMode, LpPhase, Mode, Spectrum

import bags
import hdlyap
from hdlyap import topics
import made
import test_axes
import test_data

MSG = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../msg')
# message of the variables that begin with the name of a topic
OF_TOPIC = {name: kind.__name__ for name, kind in topics.RECORDED.items()}
OF_TOPIC.update(steps='Step Steps', modes='Mode Modes', lp_phases='LpPhase LpPhases')
OF_TOPIC.update(hydro='HydroMode Hydro', t_phases='TPhase TPhases')
OF_TOPIC.update(dict.fromkeys(('covariant_orders', 'fluctuations_orders'), 'GrowthOrder'))
OF_TOPIC.update(covariant_weights='CovariantWeight', covariant_angles='CovariantAngle')
OF_TOPIC.update(fluctuations_steps='FluctuationStep')


def hydro(time):
    """Of a vector of LP(1,0) and of a T step that is not resolved."""
    nan = dict.fromkeys(('density', 'along', 'across', 'across_second', 'energy'), np.nan)
    one = HydroMode(0, 41, Mode.LP, 1, 0, 0, LpPhase.SIN_COS, 0.25, time, 0.5, 0.0, -0.125)
    return Hydro(
        run_id='one', sim_time=time, responses=[one, HydroMode(step=1, kind=Mode.T, nx=1, **nan)]
    )


def fields():
    """{(message, field): (what, unit)}"""
    found = {}
    for name in os.listdir(MSG):
        with open(os.path.join(MSG, name)) as file:
            text = re.sub(r'(?m) *\{\w[^}]*\}(?: @\w+)*$', '', file.read())
        lines = re.findall(r'(?m)^\S+ +(\w+)(?: +# ?(.*?)(?: ?\[([^]]*)\])?)?$', text)
        above = '', ''
        lines = [(field, what, unit.replace('^d', '^2')) for field, what, unit in lines]
        for field, what, unit in lines:
            above = (what or above[0], unit) if what or unit else above
            found[name[:-4], field] = above
    return found


class Everything(bags.Bags):
    def setUp(self):
        super().setUp()
        self.info, *rest = test_axes.everything()
        self.info.changes = [Change(sim_time=101.0, name='pace', value='2', before='1')]
        self.spectra = [made.spectrum(np.linspace(9, -9, 80) + t, t) for t in (40.0, 50.0)]
        for one, count in zip(self.spectra, (7, 2**40)):
            one.collisions = count
        t, lp, *others = test_axes.test_covariant_pictures.found_steps(self.info)
        steps = [made.steps([lp, t], one.averaged_time) for one in self.spectra]
        steps[1].steps[1].exponent, steps[0].c_t_error = 7.5, -1.0
        states = [test_data.state(time) for time in (140.0, 150.0)]
        rest = [one for one in rest if not isinstance(one, (Spectrum, type(steps[0])))]
        more = [*map(made.gas, (40.0, 50.0)), made.status(150.0)]
        more += [test_data.modes(150.0)] + states + [hydro(140.0), hydro(150.0)]
        self.messages = [self.info, *rest, *self.spectra, *steps, *more]
        self.run_ = self.recorded(self.messages).data
        self.states = states
        self.all = self.run_.to_xarray()

    def test_values(self):
        run = self.run_
        all_of = self.all.sel(time=run.times)  # topics of the page that is made up have others, too
        for name in ('exponents', 'std_errors'):
            self.assertEqual(all_of[name].dims, ('time', 'vector'))
            np.testing.assert_array_equal(all_of[name], getattr(run, name))
        np.testing.assert_array_equal(all_of['time'], run.times)
        np.testing.assert_array_equal(all_of['local_exponents'], run.local.exponents)
        self.assertEqual(list(all_of['spectrum_collisions']), [7, 2**40])
        self.assertEqual(list(all_of['step'].values), ['LP(1,0)', 'T(1,0)'])
        exponents = all_of['steps_exponent']
        self.assertEqual((exponents.dims, exponents.shape), (('time', 'step'), (2, 2)))
        self.assertEqual(float(exponents.sel(step='T(1,0)').isel(time=-1)), 7.5)
        self.assertEqual(set(all_of['steps_kind'].values.flat), {'LP', 'T'})
        np.testing.assert_array_equal(all_of['steps_c_t_error'], [np.nan, 0.012])
        np.testing.assert_array_equal(all_of['gas_pressure'].dims, ['time'])
        np.testing.assert_array_equal(all_of['state_px'], [one.px for one in self.states])
        self.assertEqual(all_of['state_px'].dims, ('state_time', 'particle'))
        self.assertEqual(list(all_of['particle']), list(range(1, 21)))
        np.testing.assert_array_equal(all_of['fields_dqy'].sel(vector=35), run.fields[35].dqy)
        weights = self.all['modes_weight'].sel(
            time=150.0, vector=[1, 2]
        )  # there are modes of three
        np.testing.assert_array_equal(weights, run.modes['weight'].loc[[1, 2]])
        self.assertEqual(self.all['modes_kind'].sel(time=150.0, vector=4), '')
        widths = all_of['covariant_width'].isel(covariant_time=-1)
        np.testing.assert_array_equal(widths.dropna('vector'), run.covariant['width'])
        phase = run.course('lp_phases')['phase'].unstack()
        np.testing.assert_array_equal(self.all['lp_phases_phase'].sel(time=phase.index), phase)
        self.assertEqual(all_of['hydro_along'].dims, ('time', 'response'))
        np.testing.assert_array_equal(all_of['hydro_along'], [[140, np.nan], [150, np.nan]])
        self.assertEqual(list(all_of['hydro_step'].values[0]), ['LP(1,0)', 'T(1,0)'])
        self.assertEqual(all_of['structure_along'].dims, ('wave', 'vector'))
        for name in ('along', 'across'):
            means = getattr(run.structure, name)
            held = all_of[f'structure_{name}'].dropna('vector')
            np.testing.assert_array_equal(held, means.T)
            self.assertGreater(means.to_numpy().std(), 0.0)
        waves = self.all['structure_wave_number'].dropna('time').isel(time=-1)
        np.testing.assert_array_equal(waves, run.structure.waves['wave_number'])
        info = json.loads(all_of.attrs['run_info'])
        self.assertEqual((info['number'], info['changes'][0]['name']), (20, 'pace'))

    def test_units_and_names_are_those_of_the_messages(self):
        known, seen = fields(), 0
        for name, one in self.all.data_vars.items():
            topics = (topic for topic in OF_TOPIC if name.startswith(topic + '_'))
            topic = max(topics, key=len, default='spectrum')
            field = name[len(topic) + 1 :] if name.startswith(topic + '_') else name
            said = [
                known[kind, slot]
                for kind in OF_TOPIC[topic].split()
                for slot in (field, field + 's')
                if (kind, slot) in known
            ]
            attrs = one.attrs.get('description', ''), one.attrs.get('units', '')
            self.assertLessEqual(len(one.attrs['long_name']), 32, name)  # of an axis
            self.assertIn(attrs, [tuple(map(str.strip, pair)) for pair in said], name)
            seen += bool(said)
        self.assertGreater(seen, 150)
        self.assertEqual(self.all['exponents'].attrs['units'], '1/time unit')
        for name in ('time', 'state_time'):
            self.assertEqual(self.all[name].attrs['long_name'], 'simulated time')
            self.assertIn('simulated time since', self.all[name].attrs['description'])
            self.assertEqual(self.all[name].attrs['units'], 'time units')
        self.assertEqual(self.all['vector'].attrs, {'long_name': 'Lyapunov index'})

    def test_netcdf_and_back(self):
        path = os.path.join(self.folder, 'run.nc')
        self.all.to_netcdf(path, engine='scipy')
        back = xarray.load_dataset(path)
        self.assertTrue(back.identical(self.all))
        self.assertEqual(back['spectrum_collisions'].dropna('time').values[1], 2**40)
        for name, one in self.all.variables.items():
            kinds = back[name].dtype.kind, one.dtype.kind
            self.assertIn(kinds, [('O', 'U'), (one.dtype.kind,) * 2], name)

    def test_arrays_with_a_changed_run(self):
        """What hdlyap plot --npz writes of a run that ~set has changed."""
        path = os.path.join(self.folder, 'run.npz')
        self.succeeds(
            'plot', self.run_.paths[0], '--only', 'cost', '--out', self.out, '--npz', path
        )
        info = json.loads(str(np.load(path)['info']))
        self.assertEqual(info['changes'][0]['value'], '2')


class Partly(bags.Bags):
    def test_without_a_spectrum(self):
        info, found = made.run_info(), made.steps([])
        all_of = hdlyap.load(self.write([info, found, made.gas()])).to_xarray()
        self.assertEqual(all_of['gas_pressure'].dims, ('time',))
        self.assertNotIn('exponents', all_of)

    def test_counts_that_are_large(self):
        """Beyond what integers of netCDF hold, exact."""
        spectra = [made.spectrum([9.0], time) for time in (40.0, 50.0)]
        spectra[1].collisions = 2**40 + 1
        all_of = hdlyap.load(self.write([made.run_info(), *spectra])).to_xarray()
        path = os.path.join(self.folder, 'run.nc')
        all_of.to_netcdf(path, engine='scipy')
        self.assertEqual(xarray.load_dataset(path)['spectrum_collisions'][1], 2**40 + 1)

    def test_what_does_not_count(self):
        """Averages of before they were reset."""
        found = [made.spectrum([9.0], time) for time in (40.0, 50.0, 5.0, 10.0)]
        gases = [made.gas(time) for time in (40.0, 50.0, 5.0, 10.0)]
        for one, time in zip(found + gases, (140.0, 150.0, 160.0, 165.0) * 2):
            one.sim_time = time
        all_of = hdlyap.load(self.write([made.run_info(), *found, *gases])).to_xarray()
        self.assertEqual(list(all_of['time']), [160.0, 165.0])
        self.assertEqual(list(all_of['gas_averaged_time']), [5.0, 10.0])

    def test_steps_that_come_and_go(self):
        """Of what there was not NaN."""
        info = made.run_info()
        t, lp = (made.step(info, kind, 1, 0, 36, 37) for kind in (made.T, made.LP))
        spectra = [made.spectrum([9.0] * 37, time) for time in (40.0, 50.0)]
        steps = [made.steps([t], 40.0), made.steps([t, lp], 50.0)]
        all_of = hdlyap.load(self.write([info, *spectra, *steps])).to_xarray()
        self.assertEqual(list(all_of['step'].values), ['T(1,0)', 'LP(1,0)'])
        seen = all_of['steps_resolved'].sel(step='LP(1,0)').values
        np.testing.assert_array_equal(seen, [np.nan, 1])
        self.assertEqual(list(all_of['steps_kind'].sel(step='LP(1,0)').values), ['', 'LP'])

    def test_without_xarray(self):
        run = hdlyap.load(self.write([made.run_info(), made.gas()]))
        with mock.patch.dict(sys.modules, {'xarray': None}):
            with self.assertRaisesRegex(ImportError, r'to_xarray needs xarray: python3-xarray'):
                run.to_xarray()
