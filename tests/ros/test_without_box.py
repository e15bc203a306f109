"""Bags of particles without positions in a box, whose parameters are their own."""

import csv

import yaml

import made
from bags import Bags
from hdlyap import parameters
from hdlyap.data import space
from hdlyap.data.reader import RecordingError
from hdlyap.follow import watch
from hdlyap.plots import repetition, report
from hdlyap.plots.comparison import Comparison
from hdlyap.sweep import figure, points, table
import hdlyap

OWN = ['beta=0.30000000000000004', 'energy=1', 'start=cold']


def chain(**fields):
    """As a node of a chain says: eight, of which each has one coordinate."""
    usual = dict(particles='chain', dimension=0, coordinates=1, number=8, own=OWN)
    usual.update(box_x=0.0, box_y=0.0, zero_exponents=4, packing_fraction=float('nan'))
    info = made.run_info(**{**usual, **fields})
    info.parameters = [one for one in info.parameters if one.name not in space.OF_A_BOX]
    return info


class WithoutBox(Bags):
    def spectrum(self, name, **fields):
        half = [2.0 - 0.25 * k for k in range(6)]
        exponents = half + [0.0] * 4 + [-one for one in reversed(half)]
        return self.write([chain(**fields), made.spectrum(exponents, 50.0)], name)

    def test_sizes(self):
        """Two exponents each, half of those that do not vanish positive."""
        view = watch.View()
        view.info = chain()
        self.assertEqual((view.phase_space, view.positive_end), (16, 6))

    def test_report(self):
        said = report.report(hdlyap.load(self.spectrum('a')).summary)
        self.assertIn('the last 6 exponents before the zero modes', said)
        self.assertIn('chain, N = 8, beta=0.30000000000000004, energy=1, start=cold', said)

    def test_repeated(self):
        """Nothing of a box, which the node would refuse; own parameters to the last bit."""
        asked = yaml.safe_load(repetition.scene_file(chain()))
        box = 'container density aspect aspect_z boundary_x boundary_y boundary_z coordinates own'
        self.assertFalse(set(box.split()) & set(asked))
        self.assertEqual((asked['beta'], asked['energy']), (0.1 + 0.2, 1))
        self.assertEqual((asked['particles'], asked['start']), ('chain', 'cold'))

    def test_others(self):
        """Other own parameters make another system."""
        paths = self.spectrum('a'), self.spectrum('b', seed='2', own=['beta=2', *OWN[1:]])
        with self.assertRaisesRegex(RecordingError, 'do not belong together: beta is 0.3'):
            hdlyap.load(*paths)
        with self.assertRaisesRegex(RecordingError, 'different systems .* beta .* and 2'):
            Comparison(*(hdlyap.load(path).summary for path in paths))

    def test_what_the_node_chose(self):
        """For each seed by itself: the system is the same, whose table has what was asked for."""
        paths = []
        for seed, step in (('1', '0.01'), ('2', '0.02')):
            info = chain(own=[*OWN, f'time_step={step}'], seed=seed)
            parameters.named(info, 'time_step').value = '0'
            paths.append(self.write([info, made.spectrum([2.0] * 16, 50.0)], 'seed' + seed))
        self.assertEqual(len(hdlyap.load(*paths).runs), 2)
        found, wrong = points.read(paths)
        self.assertEqual((len(found), wrong), (1, []))
        self.assertEqual(found[0].system['time_step'], 0)

    def test_averages_in_a_table(self):
        """With their names and units in text, CSV and figure, over the own parameter."""
        paths = []
        for beta in (1, 2):
            info = chain(own=[f'beta={beta}', 'energy=1'])
            told = made.averages(kinetic=0.5 * beta)
            paths.append(self.write([info, made.spectrum([2.0], 50.0), told], f'{beta}'))
        found, _ = points.read(paths)
        _, head, first, second, *_ = table.text(found)
        self.assertEqual(head.split()[:3], ['beta', 'lambda_max', 'kinetic'])
        self.assertEqual((first.split()[2], second.split()[2]), ('0.500(10)', '1.000(10)'))
        table.csv(found, self.path('table.csv'))
        with open(self.path('table.csv')) as file:
            head, *rows = csv.reader(file)
        at = head.index('kinetic [energy]')
        self.assertEqual([row[at : at + 2] for row in rows], [['0.5', '0.01'], ['1.0', '0.01']])
        panels = [axes.get_ylabel() for axes in figure.draw(found).axes]
        self.assertIn('kinetic  [energy]', panels)

    def test_table(self):
        """By own parameters as numbers, not as texts; not beside disks."""
        values = 10, 2
        paths = [self.spectrum(f'{x}', own=[f'beta={x}', 'energy=1']) for x in values]
        paths.append(self.write([made.run_info(), made.spectrum([2.0], 50.0)], 'disks'))
        found, wrong = points.read(paths)
        self.assertEqual(wrong, [f'{paths[2]}: particles = disks, but this table is of chain'])
        self.assertEqual([one.system['beta'] for one in found], [2, 10])
        first, head, *_ = table.text(found)
        self.assertEqual(first, 'the same in all: number 8, energy 1')
        self.assertEqual(head.split()[:2], ['beta', 'lambda_max'])
