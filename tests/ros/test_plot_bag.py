"""plot_bag against bags that are made here: what it prints, what it writes, what it refuses."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rosbag
import rospy

from hdlyap.msg import Cost, RunInfo, Spectrum
from std_msgs.msg import String

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../hdlyap_ros/scripts')
sys.path.insert(0, SCRIPTS)
from hdlyap_plots import paper, recording   # noqa: E402

SPECTRUM_FILES = ['convergence.png', 'convergence.svg', 'spectrum.png', 'spectrum.svg']
COST_FILES = ['cost.png', 'cost.svg']


def run_info(**fields):
    info = RunInfo(run_id='one', version='0.1.0', scene='made', disks=20, density=0.5, aspect=1.0,
                   box_x=40 ** 0.5, box_y=40 ** 0.5, boundary_x='periodic', boundary_y='periodic',
                   seed='1', exponents='positive', zero_exponents=6)
    for name, value in fields.items():
        setattr(info, name, value)
    return info


def spectrum(exponents, averaged_time, run_id='one', error=0.01, pairing_error=-1.0):
    n = len(exponents)
    return Spectrum(run_id=run_id, sim_time=100 + averaged_time, averaged_time=averaged_time,
                    collisions=1000, lambda_max=exponents[0], pairing_error=pairing_error,
                    ks_entropy=sum(e for e in exponents if e > 0), first_index=1,
                    exponents=exponents, std_errors=[error] * n, local_exponents=exponents,
                    cos_theta=[1.0] * n, dp_dq_ratio=[1.0] * n)


def cost(sim_time, run_id='one'):
    return Cost(run_id=run_id, sim_time=sim_time, phase=Cost.AVERAGING, wall_seconds=sim_time,
                events_seconds=0.1 * sim_time, replay_seconds=0.2 * sim_time,
                ortho_seconds=0.6 * sim_time)


class PlotBag(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, 'run.bag')
        self.out = os.path.join(folder.name, 'out')

    def write(self, messages, node='/hdlyap', mode='w'):
        topics = {RunInfo: 'run_info', Spectrum: 'spectrum', Cost: 'cost'}
        with rosbag.Bag(self.path, mode) as bag:
            for second, message in enumerate(messages, start=1):
                bag.write(f'{node}/{topics[type(message)]}', message, rospy.Time(second))

    def plot(self, *arguments):
        return subprocess.run([sys.executable, os.path.join(SCRIPTS, 'plot_bag'), self.path,
                               '--out', self.out, *arguments], universal_newlines=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def succeeds(self, files, *arguments):
        done = self.plot(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(sorted(os.listdir(self.out)), sorted(files))
        return done.stdout

    def refuses(self, reason, *arguments):
        done = self.plot(*arguments)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(reason, done.stderr)
        self.assertFalse(os.path.exists(self.out))

    def test_positive_half(self):
        exponents = np.linspace(3, 1, 37)
        self.write([run_info(), cost(1), *(spectrum(exponents, t) for t in range(1, 30)), cost(2)])
        text = self.succeeds(SPECTRUM_FILES + COST_FILES)
        self.assertIn('the last 37 exponents before the zeros', text)
        self.assertIn('    37   1.00000  0.01000', text)
        self.assertIn('h_KS / N        3.7', text)
        self.assertNotIn('pairing', text)

    def test_all_exponents(self):
        half = np.linspace(3, 1, 37)
        exponents = [*half, 0, 0, 0, 0, 0, 0, *-half[::-1]]
        self.write([run_info(), spectrum(exponents, 1.0, pairing_error=2e-5), cost(1)])
        text = self.succeeds(SPECTRUM_FILES + COST_FILES)
        self.assertIn('the last 37 exponents before the zeros', text)
        self.assertIn('pairing error   2.00e-05', text)

    def test_one_exponent_without_known_error(self):
        self.write([run_info(), spectrum([3.5], 1.0, error=-1.0)])
        text = self.succeeds(SPECTRUM_FILES)
        self.assertIn('     1   3.50000        -', text)
        self.assertNotIn('h_KS', text)

    def test_trajectory_only(self):
        self.write([run_info(), cost(1), cost(2)])
        self.assertIn('no averaged spectrum', self.succeeds(COST_FILES))

    def test_paper_scene(self):
        info = run_info(disks=780, density=0.8, aspect=0.867, box_x=33.535, box_y=29.074)
        exponents = np.linspace(6.8, 1.0, 1557)
        for step in paper.steps(info):
            exponents[step.first - 1:step.last] = 1.01 * step.fitted
        self.write([info, spectrum(exponents, 10.0)])
        text = self.succeeds(SPECTRUM_FILES)
        self.assertRegex(text, r'T\(1,0\) +1556-1557 +0\.18736 +0\.62\d+ +0\.01000 +0\.61\d\d +\+1\.00 %')
        self.assertEqual(text.count('+1.00 %'), 5)

    def test_averages_start_afresh_after_a_reset(self):
        times = [1, 2, 3, 1, 2]
        self.write([run_info(), *(spectrum([3.0, 2.0], t) for t in times)])
        self.assertEqual(list(recording.read(self.path).course()['time']), [1, 2])

    def test_last_of_two_runs(self):
        self.write([run_info(), spectrum([9.0], 5.0), run_info(run_id='two'),
                    spectrum([3.0], 1.0, run_id='two')])
        run = recording.read(self.path)
        self.assertEqual((run.info.run_id, run.spectrum.lambda_max), ('two', 3.0))

    def test_several_nodes(self):
        self.write([run_info(), spectrum([3.0], 1.0)], node='/hdlyap')
        self.write([run_info(), spectrum([4.0], 1.0)], node='/far/away', mode='a')
        self.refuses('choose one with --node: /far/away, /hdlyap')
        self.refuses('no node other in it', '--node', 'other')
        self.assertIn('lambda_max      4.0', self.succeeds(SPECTRUM_FILES, '--node', 'far/away'))

    def test_bag_without_run_info(self):
        self.write([spectrum([3.0], 1.0)])
        self.refuses('no run_info')

    def test_foreign_bag(self):
        with rosbag.Bag(self.path, 'w') as bag:
            bag.write('/chatter', String('hello'), rospy.Time(1))
        self.refuses('nothing in it was published by hdlyap_node')

    def test_missing_file(self):
        self.refuses('No such file')

    def test_not_a_bag(self):
        for content in b'', b'something else entirely\n' * 10:
            with open(self.path, 'wb') as file:
                file.write(content)
            self.refuses('not a readable bag')

    def test_unindexed_bag(self):
        bag = rosbag.Bag(self.path, 'w')
        bag.write('/hdlyap/run_info', run_info(), rospy.Time(1))
        bag.flush()
        with open(self.path, 'rb') as file:
            content = file.read()
        bag.close()
        with open(self.path, 'wb') as file:
            file.write(content)
        self.refuses('rosbag reindex')


if __name__ == '__main__':
    unittest.main()
