#!/usr/bin/env python3
"""What sweeps and recorders share: a scene and what is given besides become parameters or are
refused, bags are not overwritten. Needs no ROS master."""
# Second tier: tests/run.sh --all

import os
import re
import subprocess
import tempfile
import unittest

import rospkg

from hdlyap.runs import bags, scene

GUIDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../doc/user_guide.md')
LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text=''):
        with open(self.path(name), 'w') as file:
            file.write(text)


class Parameters(InFolder):
    def of(self, **given):
        return scene.parameters(given, LAUNCH, self.folder)

    def refused(self, what, says, **given):
        with self.assertRaises(scene.Refused) as caught:
            self.of(**given)
        line = str(caught.exception)
        self.assertNotIn('\n', line)
        self.assertTrue(line.startswith(what + ' = '), line)
        self.assertIn('must be', line)
        self.assertIn(says, line)

    def test_scene_and_what_is_given_besides(self):
        """Numbers are numbers, a text is left to the node, which knows what it must be."""
        found = self.of(
            scene='quick',
            disks='50',
            density='0.55',
            aspect='1e-1',
            duration='abc',
            seed='18446744073709551615',
            observables='[spectrum, steps]',
            params='{warmup: 20, field_indices: [1, 2]}',
            pace='',
        )
        self.assertEqual(
            found,
            dict(
                scene='quick',
                disks=50,
                density=0.55,
                aspect='1e-1',
                duration='abc',
                seed='18446744073709551615',
                observables='[spectrum, steps]',
                warmup=20,
                field_indices=[1, 2],
                equilibration=20.0,
            ),
        )

    def test_long_numbers_become_strings(self):
        """Which the master's integers do not hold."""
        self.write('own.yaml', 'disks: 5000000000\n')
        found = self.of(scene='own.yaml', params='{seed: 18446744073709551615}')
        self.assertEqual((found['disks'], found['seed']), ('5000000000', '18446744073709551615'))

    def test_a_file_without_a_name_is_named_after_itself(self):
        self.write('own.yaml', 'disks: 50\n')
        self.assertEqual(self.of(scene='own.yaml'), dict(scene='own', disks=50))
        self.assertEqual(self.of(scene=self.path('own.yaml'))['scene'], 'own')
        self.write('own.yaml', 'scene: other\n')
        self.assertEqual(self.of(scene='own.yaml'), dict(scene='other'))

    def test_refused(self):
        self.write('broken.yaml', 'disks: 5\n  aspect: {\n')
        self.write('list.yaml', '[1]\n')
        self.refused('scene', 'covariant, dense,', scene='quik')
        self.refused('scene', 'No such file', scene='quik.yaml')
        self.refused('scene', 'line 2', scene='broken.yaml')
        self.refused('scene', 'YAML file of parameters', scene='list.yaml')
        self.refused('params', 'line 1', scene='quick', params='{warmup: 20')
        self.refused('params', '{parameter: value', scene='quick', params='warmup')
        self.refused('params', 'without disks', scene='quick', params='{disks: 20}', disks='30')


class Scenes(unittest.TestCase):
    def test_table_in_the_guide(self):
        """Has all of them, with their numbers of disks."""
        with open(GUIDE) as file:
            section = file.read().split('### Scenes')[1].split('###')[0]
        stated = dict(re.findall(r'(?m)^\| `(\w+)` \| (\d+) \|', section))
        disks = {}
        for name in os.listdir(os.path.join(LAUNCH, 'scenes')):
            values = scene.scene_file(name[: -len('.yaml')], LAUNCH, '.')
            disks[values['scene']] = str(values.get('disks', 780))
        self.assertEqual(stated, disks)


class Bags(InFolder):
    def files(self):
        return sorted(os.listdir(self.folder))

    def kept(self):
        return list(bags.keep(self.path('run.bag')))

    def test_none_in_the_way(self):
        self.write('run.bag.old')
        self.write('run_again.bag')
        self.assertEqual(self.kept(), [])
        self.assertEqual(self.files(), ['run.bag.old', 'run_again.bag'])

    def test_old_ones_are_kept(self):
        for number in '12':
            self.write('run.bag', number)
            self.assertEqual(len(self.kept()), 1)
        self.assertEqual(self.files(), ['run.bag.old', 'run.bag.old2'])
        for name, text in (('run.bag.old', '1'), ('run.bag.old2', '2')):
            with open(self.path(name)) as file:
                self.assertEqual(file.read(), text)

    def test_parts_and_what_was_cut_short(self):
        """All of a run get the same ending."""
        for name in (
            'run_0.bag',
            'run_1.bag',
            'run_2.bag.active',
            'run.bag.active',
            'run_1.bag.old',
        ):
            self.write(name)
        self.assertEqual(len(self.kept()), 4)
        self.assertEqual(
            self.files(),
            [
                'run.bag.active.old2',
                'run_0.bag.old2',
                'run_1.bag.old',
                'run_1.bag.old2',
                'run_2.bag.active.old2',
            ],
        )

    def test_one_that_is_written(self):
        path = self.path('run.bag.active')
        with open(path, 'w') as file:
            writer = subprocess.Popen(['sleep', '60'], stdout=file)
        self.addCleanup(writer.wait)
        self.addCleanup(writer.kill)
        patience, bags.PATIENCE = bags.PATIENCE, 0.0
        self.addCleanup(setattr, bags, 'PATIENCE', patience)
        with self.assertRaisesRegex(bags.InUse, f'process {writer.pid} writes {path}'):
            self.kept()
        self.assertEqual(self.files(), ['run.bag.active'])


if __name__ == '__main__':
    unittest.main()
