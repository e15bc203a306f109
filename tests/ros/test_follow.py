"""follow: what its screen shows of made messages, and of real nodes on a terminal of its own."""

import os
import signal
import sys
import unittest

import numpy as np

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

import harness
import made
import rosgraph
from hdlyap.msg import Cost, LpPhase, RunStatus
from made import LP, SCRIPTS, T
from terminal import Terminal
from hdlyap.follow import layout, panels
from hdlyap.follow.screen import clean, cut
from hdlyap.follow.watch import Speed, View, fill, lazy
from hdlyap.plots.glyphs import Glyphs

FOLLOW = os.path.join(SCRIPTS, 'follow')
SIZES = (80, 24), (120, 40), (200, 60), (60, 15), (30, 5), (7, 2), (1, 1)
OBSERVED = ['spectrum', 'steps', 'lp_phases']
PACED = dict(harness.MODES, equilibration=1.0, warmup=20.0, duration=0.0, pace=100.0)
# a short run does not begin before it is watched
SEEN = dict(wait_for_subscribers=['cost', 'spectrum'])
SCREEN = 'from hdlyap.follow.screen import Screen\n'


def cost(**fields):
    message = made.cost(150.0)
    message.interval, message.interval_limit = 2.37, Cost.LIMIT_CONDITION
    message.orthonormalisations, message.repairs = 60, 4
    message.condition, message.error_bound = 2.8e5, 1.2e-10
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def status(**fields):
    values = dict(remaining_seconds=65.0, progress=0.5, std_error=-1.0)
    return made.status(150.0, **{**values, **fields})


def diagnosis(level=0, text='averaging', stage='averaging'):
    return DiagnosticStatus(
        level=level, name='/hdlyap', message=text, values=[KeyValue('stage', stage)]
    )


def view(**fields):
    """Of a run of 20 disks with four steps."""
    info = fields.pop('info', None) or made.run_info(observables=OBSERVED, duration=200.0)
    found = [
        made.step(info, T, 1, 0, 36, 37),
        made.step(info, LP, 1, 0, 32, 35),
        made.step(info, T, 0, 1, 30, 31),
        made.unresolved(info, LP, 0, 1, 4),
    ]
    shown = View()
    values = dict(
        node='/hdlyap',
        info=info,
        status=status(),
        cost=cost(),
        speed=1.234,
        spectrum=made.spectrum(np.linspace(9, 3, 37), 50.0),
        steps=made.steps([*found, made.zero_modes()]),
        phases=made.lp_phases(info, found, 150.0, began=100.0),
        diagnosis=diagnosis(),
        others=set(OBSERVED),
    )
    for name, value in {**values, **fields}.items():
        setattr(shown, name, value)
    return shown


def drawn(shown, size=(80, 24), plain=False):
    return [
        ''.join(text for text, _ in cut(line, size[0]))
        for line in layout.lines(shown, size, Glyphs(plain))
    ]


class Screens(unittest.TestCase):
    def text(self, shown, size=(80, 24), **options):
        lines = drawn(shown, size, **options)
        self.assertLessEqual(len(lines), size[1])
        return '\n'.join(lines)

    def test_everything_is_there(self):
        for size in ((80, 24), (120, 40)):
            text = self.text(view(), size)
            for part in (
                '/hdlyap  made  seed 1  run one',
                'N = 20, density 0.5',
                'averaging  ██',
                ' 50.0 %  1:05 left',
                'simulated 150.0',
                'averaged 50.0 of 200',
                '1.23 time units/s',
                'lambda_max 9.000(10)',
                'h_KS 222.00(37)',
                'c_T 1.400(12) (c k + c2 k^2',
                'c_L 1.500(20) (c k + c2 k^2',
                'v 1.612(23)',
                'steps resolved 3 of 4',
                'interval 2.37 (conditioning)',
                'repairs 4',
                'condition 2.8e+05',
                'error bound 1.2e-10',
                'OK  averaging',
                'q quit',
            ):
                self.assertIn(part, text)
            self.assertRegex(text, r'T\(1,0\) +36-37 +1\.98 +2 +0\.99346 +1\.4895\(20\)')
            self.assertRegex(text, r'ortho +█+.? +55 %')
            self.assertRegex(text, r'other +▋ +10 %')

    def test_fits_say_what_they_stand_on(self):
        """Their forms on every screen, their wave numbers where there is room."""
        shown = view()
        shown.steps.l_points = shown.steps.l_terms = 1
        self.assertIn(
            'c_T 1.400(12) (c k + c2 k^2)   c_L 1.500(20) (c k)   v 1.612(23)\n', self.text(shown)
        )
        self.assertIn(
            'c_T 1.400(12) (c k + c2 k^2 over 3 wave numbers 0.9935 .. 1.987)\n',
            self.text(shown, (80, 30)),
        )

    def test_phases(self):
        """At t = 50 since they began, of vector 33: v k t = 1.6 * 0.99346 * 50 = 12.649 turns."""
        info = made.run_info(observables=OBSERVED)
        step = made.step(info, LP, 1, 0, 33, 33)
        message = made.lp_phases(info, [step], 150.0, began=100.0, modulations=(1,))
        self.assertRegex(
            self.text(view(info=info, phases=message)),
            r'LP\(1,0\) +sin kx x +33 +1\.00  ↙ 0\.65  1\.590\(16\) +1\.600\(16\)',
        )
        message.phases[0].state = LpPhase.WEAK
        self.assertIn('too weak now', self.text(view(phases=message)))

    def test_dial(self):
        hands = [Glyphs().dial(turn) for turn in (0, 0.125, 0.25, 0.5, 0.75, 0.94, 0.99)]
        self.assertEqual(''.join(hands), '→↗↑←↓→→')

    def test_bar(self):
        for share, bar in (
            (0, '    '),
            (0.5, '██  '),
            (0.53125, '██▏ '),
            (1, '████'),
            (7, '████'),
            (-1, '    '),
            (float('nan'), '    '),
        ):
            self.assertEqual(Glyphs().bar(share, 4), bar)
        self.assertEqual(Glyphs(plain=True).bar(0.6, 4, rest=True), '##..')

    def test_ascii(self):
        self.assertTrue(self.text(view(), plain=True).isascii())

    def test_phases_take_turns(self):
        """Of two steps one each, then one each; of a step first another vector and pair."""
        info = made.run_info()
        both = [made.step(info, LP, 1, 0, 34, 35), made.step(info, LP, 0, 1, 30, 31)]
        message = made.lp_phases(info, both, 150.0)
        self.assertEqual(
            [(phase.ny, phase.index, phase.modulation) for phase in panels.ranked(message.phases)][
                :5
            ],
            [(0, 34, 0), (1, 30, 0), (0, 35, 1), (1, 31, 1), (0, 34, 1)],
        )
        for phase in message.phases[:4]:
            phase.state = LpPhase.UNRESOLVED
        self.assertEqual({phase.ny for phase in panels.ranked(message.phases)}, {1})

    def test_errors_that_are_not_known(self):
        shown = view(spectrum=made.spectrum([9.0, 3.0], 1.0, error=-1.0))
        shown.steps.c_t_error = -1.0
        shown.steps.c_l = shown.cost.condition = float('nan')
        shown.phases.phases[0].a = shown.phases.phases[1].omega_error = float('nan')
        text = self.text(shown)
        for part in (
            'lambda_max 9.00000 ',
            'sum of exponents 12.00000 ',
            'c_T 1.40000 ',
            'c_L -',
            'condition nan',
        ):
            self.assertIn(part, text)
        self.assertNotIn('-1.0', text)

    def test_what_is_not_there(self):
        nothing = dict(
            status=None,
            cost=None,
            spectrum=None,
            steps=None,
            phases=None,
            diagnosis=None,
            speed=None,
        )
        self.assertIn('waiting for its first word', self.text(view(**nothing)))
        self.assertIn('/hdlyap', self.text(view(**nothing, info=None)))
        unheard = view(steps=None, phases=None, others=set())
        self.assertIn('steps: computed only if somebody listens; m:', self.text(unheard))
        self.assertIn('m compute steps and phases', self.text(unheard))
        alone = view(
            info=made.run_info(observables=['spectrum']), steps=None, phases=None, others=set()
        )
        self.assertNotIn('steps', self.text(alone))
        self.assertNotIn('LP phases', self.text(alone))
        none_yet = view(
            steps=made.steps([made.unresolved(made.run_info(), T, 1, 0, 2)]),
            phases=made.lp_phases(made.run_info(), [], 100.0),
        )
        self.assertIn('steps: none resolved yet', self.text(none_yet))
        self.assertIn('no LP step resolved yet', self.text(none_yet))

    def test_shapes_of_scenes(self):
        half = np.linspace(3, 1, 37)
        whole = view(
            spectrum=made.spectrum([*half, *[0.0] * 6, *-half[::-1]], 50.0, pairing_error=2e-5)
        )
        whole.steps.steps[-1] = made.zero_modes(38)
        text = self.text(whole, (120, 40))
        self.assertRegex(text, r'zero modes +38-43 +6\.00')
        self.assertIn('pairing error 2.0e-05', text)
        paper = view(info=made.paper_info(), spectrum=made.spectrum(np.linspace(6, 1, 1557), 50.0))
        self.assertIn('deviation', self.text(paper, (120, 40)))
        self.assertNotIn('deviation', self.text(paper))
        one = self.text(view(spectrum=made.spectrum([9.0], 50.0), steps=None, phases=None))
        self.assertIn('lambda_max', one)
        self.assertNotIn('sum', one)
        endless = self.text(view(status=status(progress=0.0, remaining_seconds=-1.0)))
        self.assertNotIn('left', endless)
        self.assertIn(
            'std error ? of 0.01',
            self.text(view(info=made.run_info(observables=OBSERVED, target_std_error=0.01))),
        )

    def test_every_size(self):
        info = made.run_info(observables=OBSERVED)
        many = view(
            steps=made.steps([made.step(info, T, n, 1, 2 * n, 2 * n + 1) for n in range(1, 40)])
        )
        for size in SIZES:
            for shown in (many, view(), view(is_gone=True, is_master_gone=True, status=None)):
                lines = drawn(shown, size)
                self.assertLessEqual(len(lines), size[1])
                self.assertLessEqual(max(map(len, lines)), size[0])
            self.assertIn('averag'[: size[0]], '\n'.join(drawn(many, size)))
        self.assertIn('   36 more\n', self.text(many, (80, 18)))
        self.assertNotIn('more\n', self.text(many, (200, 80)))

    def test_condition_of_the_node(self):
        for fields, text in (
            (dict(diagnosis=diagnosis(1, 'overlap')), 'WARN  overlap'),
            (dict(diagnosis=diagnosis(2, 'disk full')), 'ERROR  disk full'),
            (dict(diagnosis=diagnosis(stage='paused')), 'paused  █'),
            (dict(is_gone=True), 'GONE  /hdlyap does not answer'),
            (dict(silence=63.0), 'no message for 1:03'),
            (dict(is_master_gone=True), 'no master'),
            (dict(status=status(stage=RunStatus.FINISHED), is_gone=True), 'the run has finished'),
        ):
            self.assertIn(text, self.text(view(**fields)))

    def test_speed(self):
        speed = Speed()
        seen = [
            speed.add(made.Cost(wall_seconds=wall, sim_time=time))
            for wall, time in ((1, 10), (2, 30), (12, 130), (22, 130), (1, 5), (3, 15))
        ]
        self.assertEqual(seen, [None, 20.0, 10.0, 0.0, None, 5.0])

    def test_a_run_before_is_not_shown(self):
        shown = View()
        fill(
            shown,
            {
                'steps': made.steps([]),
                'run_info': made.run_info(run_id='two'),
                'spectrum': made.spectrum([3.0], 1.0),
                'status': status(run_id='two'),
                'cost': cost(run_id='one'),
            },
        )
        self.assertEqual((shown.info.run_id, shown.status.run_id), ('two', 'two'))
        self.assertEqual((shown.steps, shown.spectrum, shown.cost), (None, None, None))

    def test_messages_are_unpacked_when_asked(self):
        class Counted(made.Spectrum):
            unpacked = 0

            def deserialize(self, data):
                Counted.unpacked += 1
                return super().deserialize(data)

        import io

        buffer = io.BytesIO()
        made.spectrum([3.0], 1.0).serialize(buffer)
        message = lazy(Counted)().deserialize(buffer.getvalue())
        self.assertEqual(Counted.unpacked, 0)
        self.assertEqual([message.unpacked().lambda_max for _ in range(2)], [3.0, 3.0])
        self.assertEqual(Counted.unpacked, 1)

    def test_a_name_is_no_command(self):
        self.assertEqual(clean('a\033[2Jb\r\x9bc'), 'a?[2Jb??c')


class OnATerminal(unittest.TestCase):
    """Of the terminal alone, without ROS."""

    def program(self, text):
        terminal = Terminal([sys.executable, '-c', SCREEN + text])
        self.addCleanup(terminal.stop)
        return terminal

    def test_exception(self):
        terminal = self.program(
            'with Screen() as screen:\n' '    screen.show([[("here", "")]], (80, 24))\n    wrong'
        )
        self.assertEqual(terminal.wait(), 1)
        self.assertTrue(terminal.wait_for("name 'wrong' is not defined"))
        self.assertNotIn('here', '\n'.join(terminal.screen()))
        self.assertTrue(harness.wait_until(terminal.is_as_before))

    def test_suspended_and_continued(self):
        terminal = self.program(
            'with Screen() as screen:\n    while screen.key(0.1) != "q":\n'
            '        screen.show([[("here", "")]], (80, 24))'
        )
        self.assertTrue(terminal.wait_for('here'))
        self.assertFalse(terminal.is_as_before())
        terminal.press('\x1a')
        os.waitid(os.P_PID, terminal.process.pid, os.WSTOPPED | os.WNOWAIT)
        self.assertTrue(harness.wait_until(terminal.is_as_before))
        os.kill(terminal.process.pid, signal.SIGCONT)
        self.assertTrue(terminal.wait_for('here'))
        terminal.press('q')
        self.assertEqual(terminal.wait(), 0)
        self.assertTrue(harness.wait_until(terminal.is_as_before))

    def test_complaints_do_not_reach_the_screen(self):
        terminal = self.program(
            'import os\nwith Screen() as screen:\n'
            '    os.write(2, b"a complaint")\n'
            '    screen.show([[("here", "")]], (80, 24))\n    screen.key(60)'
        )
        self.assertTrue(terminal.wait_for('here'))
        self.assertEqual(terminal.screen(), ['here'])
        terminal.press('q')
        self.assertEqual(terminal.wait(), 0)
        self.assertTrue(terminal.wait_for('a complaint'))


class Running(unittest.TestCase):
    """Beside real nodes, under a master of their own."""

    @classmethod
    def setUpClass(cls):
        cls.port = harness.free_port()
        cls.master = harness.Master(cls.port)
        cls.addClassCleanup(cls.master.stop)
        cls.env = {'ROS_MASTER_URI': cls.master.uri}

    def node(self, **params):
        node = harness.start({**PACED, **params}, **self.env)
        self.addCleanup(node.stop)
        return node

    def follow(self, *arguments, **size):
        terminal = Terminal([sys.executable, FOLLOW, *arguments], **size, **self.env)
        self.addCleanup(terminal.stop)
        return terminal

    def shows(self, terminal, text):
        self.assertTrue(terminal.wait_for(text), '\n'.join([text, '', *terminal.screen()]))

    def listeners(self):
        """Topics of the node that somebody listens to."""
        _, subscribers, _ = rosgraph.Master('/test', self.master.uri).getSystemState()
        return {
            topic.rpartition('/')[2]
            for topic, names in subscribers
            if topic.startswith('/hdlyap/') and names
        }

    def test_watches_and_is_interrupted(self):
        self.node()
        terminal = self.follow()
        self.shows(terminal, 'computed only if somebody listens')
        self.shows(terminal, 'lambda_max')
        self.assertEqual(self.listeners(), {'run_info', 'status', 'cost', 'spectrum'})
        terminal.press('m')
        self.shows(terminal, ' 116-117 ')
        self.shows(terminal, 'no more steps and phases')
        terminal.press('m')
        self.shows(terminal, 'computed only if somebody listens')
        self.assertEqual(self.listeners(), {'run_info', 'status', 'cost', 'spectrum'})
        terminal.resize(50, 10)
        self.assertTrue(harness.wait_until(lambda: len(terminal.screen()) <= 10))
        terminal.press('\x03')
        self.assertEqual(terminal.wait(), 130)
        self.assertTrue(harness.wait_until(terminal.is_as_before))
        self.shows(terminal, 'lambda_max')

    def test_node_and_master_that_die_and_come_back(self):
        first = self.node(seed='17')
        patient, leaving, line = self.follow(), self.follow(), self.follow('--line')
        for terminal in (patient, leaving):
            self.shows(terminal, 'seed 17')
        self.shows(line, 'averaging')
        first.stop()
        self.assertEqual(line.wait(), 3)
        self.assertNotIn('\033[?', line.output)
        self.shows(leaving, 'GONE  /hdlyap does not answer')
        leaving.press('q')
        self.assertEqual(leaving.wait(), 3)
        self.shows(leaving, 'follow: /hdlyap went away before the end of its run')
        self.master.stop()
        self.shows(patient, 'no master  what connected before goes on')
        self.addClassCleanup(harness.Master(self.port).stop)
        self.node(seed='18', duration=10.0, **SEEN)
        self.shows(patient, 'seed 18')
        self.shows(patient, 'the run has finished')
        self.assertNotIn('no master', '\n'.join(patient.screen()))
        patient.press('q')
        self.assertEqual(patient.wait(), 0)
        self.assertTrue(harness.wait_until(patient.is_as_before))

    def test_one_line_until_the_end(self):
        self.node(duration=60.0, **SEEN)
        process = harness.Process([sys.executable, FOLLOW], **self.env)
        self.addCleanup(process.stop)
        self.assertTrue(
            harness.wait_until(lambda: self.listeners() == {'status', 'cost', 'spectrum'})
        )
        self.assertEqual(process.wait(), 0, process.text())
        self.assertRegex(process.text().splitlines()[-1], r'^finished  100\.0 %  t = 81\.0')

    def test_no_node(self):
        terminal = self.follow('--timeout', '0.1')
        self.assertEqual(terminal.wait(), 1)
        self.shows(terminal, 'follow: no hdlyap_node is running')


if __name__ == '__main__':
    unittest.main()
