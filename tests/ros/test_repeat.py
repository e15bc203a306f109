"""The scene file of a recorded run, from its run_info alone."""

import os

import yaml

from hdlyap.msg import Change
import made
from bags import Bags, process, tool
from hdlyap.data.reader import RecordingError
from hdlyap.plots import repetition

SCENES = os.path.join(made.SCRIPTS, '../../launch/scenes')


def text_of(value):
    """As the node shows a parameter."""
    return '[' + ', '.join(map(str, value)) + ']' if isinstance(value, list) else str(value)


def complete(name):
    """A scene with all parameters: of those that it does not list, those of the paper's."""
    scene = {}
    for path in ('paper_periodic.yaml', name):
        with open(os.path.join(SCENES, path)) as file:
            scene.update(yaml.safe_load(file))
    scene.pop('table')  # of the log: it does not belong to the run
    if scene['particles'] != 'spheres':
        for name in 'aspect_z', 'boundary_z':
            scene.pop(name)
    return scene


def info_of(scene, **others):
    """run_info of a node that was given a scene file."""
    values = {name: text_of(scene[name]) for name in ('exponents', 'field_indices')}
    own = {
        name: value for name, value in scene.items() if name not in (*made.PARAMETERS, 'changes')
    }
    said = {name: value for name, value in scene.items() if name not in own}
    said['own'] = [f'{name}={value}' for name, value in own.items()]
    return made.run_info(**{**said, **values, 'threads': 2, **others})


class Repeat(Bags):
    def text(self, node=None, number=None):
        return repetition.scene_file(repetition.chosen(self.path(), node, number))

    def repeated(self, node=None, number=None):
        return yaml.safe_load(self.text(node, number))

    def refused(self, node=None, number=None):
        with self.assertRaises(RecordingError) as caught:
            self.text(node, number)
        return str(caught.exception)

    def test_command(self):
        infos = [made.run_info(run_id=run_id, seed=run_id) for run_id in '12']
        path = self.write(infos)
        text = self.succeeds('repeat', path, '--node', 'hdlyap', '--run', '2', how=process)
        self.assertEqual(text, repetition.scene_file(infos[1]))
        said = f'hdlyap repeat: {path}: several runs, choose with --run: 1 (1), 2 (2)\n'
        self.assertEqual(tool('repeat', path), (1, '', said))

    def test_every_scene(self):
        """What comes out is what went in, every parameter of it, and of the types that the node
        wants."""
        for name in sorted(os.listdir(SCENES)):
            with self.subTest(scene=name):
                scene = complete(name)
                got = yaml.safe_load(repetition.scene_file(info_of(scene)))
                want = dict(scene, threads=2, exponents=str(scene['exponents']))
                self.assertEqual(got, want)
                for key, value in want.items():
                    self.assertIs(type(got[key]), type(value), key)

    def test_what_a_curved_wall_leaves_no_choice_of(self):
        """Its boundaries, and of a circle the aspect."""
        curved = dict(boundary_x='curved', boundary_y='curved', outline_x=[1.0], outline_y=[2.0])
        without = {'boundary_x', 'boundary_y', 'outline_x', 'outline_y'}
        for container, more in (('circle', {'aspect'}), ('lens', set())):
            info = info_of(complete('circle.yaml'), **{**curved, 'container': container})
            asked = repetition.parameters(info)
            self.assertEqual({'aspect', 'container', *without} - set(asked), without | more)

    def test_values_that_yaml_may_misread(self):
        scene = dict(
            complete('quick.yaml'),
            seed='18446744073709551615',
            accuracy=1e-12,
            scene='off',
            exponents='007',
            field_indices=[37, 1],
            observables=[],
            interval=1e-6,
            density=0.1 + 0.2,
            wait_for_subscribers=['cost', 'run_info'],
        )
        self.write([info_of(scene)])
        self.assertEqual(self.repeated(), dict(scene, threads=2))

    def test_begins_anew(self):
        self.write([made.run_info(checkpoint='kept', resume='before', resumed_time=12.5)])
        got = self.repeated()
        self.assertEqual((got['checkpoint'], got['resume']), ('', ''))
        self.assertIn('# That run went on from before at simulated time 12.5', self.text())

    def test_changes(self):
        """What was changed is as it was at the start, and is changed again; each run_info of the
        run says a little more, and that of a second file of the bag, the first one, nothing."""
        changes = [
            Change(sim_time=0.1 + 0.2, name='pace', before='2', value='1e-07'),
            Change(sim_time=1e3, name='duration', before='0', value='100'),
            Change(sim_time=1e3, name='pace', before='1e-07', value='3'),
            Change(sim_time=2e3, name='target', before='v 1%', value='h_KS 2, c_T 1%'),
        ]
        now = dict(pace=3.0, duration=100.0, target='h_KS 2, c_T 1%')
        infos = [
            made.run_info(pace=2.0),
            made.run_info(pace=1e-7, changes=changes[:1]),
            made.run_info(changes=changes, **now),
            made.run_info(pace=2.0),
        ]
        self.write(infos)
        got = self.repeated()
        self.assertEqual((got['pace'], got['duration'], got['target']), (2.0, 0.0, 'v 1%'))
        self.assertEqual(
            got['changes'],
            [
                '0.30000000000000004 pace=1e-07',
                '1000.0 duration=100',
                '1000.0 pace=3',
                '2000.0 target=h_KS 2, c_T 1%',
            ],
        )
        self.write(infos[:1])
        self.assertEqual(self.repeated()['changes'], [])

    def test_what_it_ran_on(self):
        """Beside the parameters; texts of a bag cannot add any."""
        self.write([made.run_info(blas_kernel='Zen\nnumber: 5', version='1.2.3')])
        first, second, third = self.text().splitlines()[:3]
        self.assertEqual(first, '# Repeats the run one.')
        self.assertIn('(1.2.3)', second)
        self.assertIn('(OPENBLAS_CORETYPE=Zen number: 5)', second)
        self.assertEqual(third, 'scene: made')

    def test_several_runs(self):
        infos = [
            made.run_info(run_id=run_id, seed=seed)
            for run_id, seed in (('one', '1'), ('two', '2'), ('two', '2'))
        ]  # as in files of a bag that was split
        self.write(infos)
        self.assertIn('several runs, choose with --run: 1 (one), 2 (two)', self.refused())
        self.assertEqual([self.repeated(number=k)['seed'] for k in (1, 2)], ['1', '2'])
        for number in (0, 3, -1):
            self.assertIn(
                f'no run {number} in it, choose with --run: 1 (one), 2 (two)',
                self.refused(number=number),
            )

    def test_several_nodes(self):
        self.write([made.run_info(seed='1')], node='/one')
        self.write([made.run_info(seed='2')], node='/group/two', mode='a')
        self.assertEqual(self.repeated('/group/two')['seed'], '2')
        self.assertEqual(self.repeated('one')['seed'], '1')
