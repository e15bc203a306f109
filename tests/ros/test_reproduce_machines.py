"""Which machine each run of reproduce.launch goes to, and the script that queues them."""
# Second tier: tests/run.sh --all

import os
import subprocess
import unittest
from unittest import mock

import roslaunch.config

from hdlyap.runs import files
from test_reproduce import LAUNCH, Folder


class Machines(Folder):
    """The machine tags of a file of the user, by turns; the recorder runs where its node does."""

    def loaded(self, names, machines):
        files.write(
            self.path('machines.launch'),
            '<launch>%s</launch>'
            % ''.join(
                f'<machine name="{name}" address="localhost" env-loader="/opt/{name}/env.sh"/>'
                for name in ('m1', 'm2')
            ),
        )
        for name in names:
            files.write(self.path(name + '.yaml'), f'scene: {name}\n')
        with mock.patch.dict(os.environ, PWD=self.folder):
            return roslaunch.config.load_config_default(
                [
                    (
                        os.path.join(LAUNCH, 'reproduce.launch'),
                        [
                            'runs:=' + ' '.join(names),
                            'machines:=' + machines,
                            'machine_file:=machines.launch',
                        ],
                    )
                ],
                0,
            )

    def placed(self, config):
        return {
            node.namespace + node.name: config.machines[node.machine_name].env_loader
            if node.machine_name
            else None
            for node in config.nodes
        }

    def test_by_turns(self):
        config = self.loaded(['a', 'b', 'c'], 'm1 m2')
        one, two = '/opt/m1/env.sh', '/opt/m2/env.sh'
        self.assertEqual(
            self.placed(config),
            {
                '/a/hdlyap': one,
                '/a/record': one,
                '/b/hdlyap': two,
                '/b/record': two,
                '/c/hdlyap': one,
                '/c/record': one,
                '/table': None,
            },
        )
        params = {key: value.value for key, value in config.params.items()}
        for name in 'abc':
            self.assertEqual(params[f'/{name}/hdlyap/scene'], name)
            self.assertEqual(params[f'/{name}/hdlyap/wait_for_subscribers'], 'all')
            self.assertEqual(params[f'/{name}/record/node'], 'hdlyap')
            self.assertEqual(params[f'/{name}/record/bag'], f'{self.folder}/./{name}.bag')
        self.assertFalse(any(node.required for node in config.nodes if node.name != 'table'))

    def test_one_and_here(self):
        config = self.loaded(['a'], '')
        self.assertEqual(self.placed(config), {'/a/hdlyap': None, '/a/record': None})
        self.assertTrue(all(node.required for node in config.nodes))


class Submission(unittest.TestCase):
    def test_parses(self):
        """What it does is tests/ros/test_reproduce_runs.py's."""
        subprocess.run(['bash', '-n', os.path.join(LAUNCH, 'reproduce.sbatch')], check=True)
        lines = files.read(os.path.join(LAUNCH, 'reproduce.sbatch')).splitlines()
        self.assertEqual(lines[0], '#!/usr/bin/env bash')
        for line in lines[
            1 : next(k for k, line in enumerate(lines) if k and not line.startswith('#SBATCH'))
        ]:
            self.assertRegex(line, r'^#SBATCH --[a-z-]+=\S+$')


if __name__ == '__main__':
    unittest.main()
