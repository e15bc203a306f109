"""follow: what its lines say of made messages."""

import io
import itertools
import unittest
from unittest import mock

import numpy as np

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

import bags
import made
from hdlyap.follow import line
from hdlyap.follow.news import NOT_HEARD, News
from hdlyap.follow.watch import Speed, View, fill, lazy
from hdlyap.msg import Cost, RunStatus
from made import LP, T

OBSERVED = ['spectrum', 'steps', 'lp_phases']


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
        diagnosis=diagnosis(),
        others=set(OBSERVED),
    )
    for name, value in {**values, **fields}.items():
        setattr(shown, name, value)
    return shown


def said(shown):
    """The parts of the line."""
    return line.understood(line.parts, shown)


def told(shown, news=None):
    """What a new follower, or this one, says above it."""
    return line.understood((news or News()).of, shown)


def with_all(message, kind, number):
    """Every field of this type, of the parts of the message too, becomes the number."""
    for name in message.__slots__:
        value = getattr(message, name)
        if isinstance(value, (list, tuple)):
            for part in value:
                if hasattr(part, '__slots__'):
                    with_all(part, kind, number)
        elif type(value) is kind:
            setattr(message, name, number)


class Line(unittest.TestCase):
    def test_parts(self):
        shown = view(
            status=status(target='c_T', target_error=0.0123, target_wanted=0.0098),
            spectrum=made.spectrum([9.0, 3.0], 50.0),
            diagnosis=diagnosis(1, 'disks overlap'),
        )
        parts = ['averaging', '50.0 %', 't = 150.0', '1.23 time units/s', '1:05 left']
        parts += ['error of c_T 0.012, wanted 0.0098', 'lambda_max 9.000(10)']
        parts += ['interval 2.37 (conditioning), repairs 4', 'classification 5 % of the time']
        self.assertEqual(said(shown), [*parts, 'WARN: disks overlap'])

    def test_what_is_said(self):
        """Of what is known, and of what is not."""
        nothing = dict.fromkeys(('status', 'cost', 'spectrum', 'steps', 'diagnosis', 'speed'))
        finished = status(stage=RunStatus.FINISHED)
        asked = dict(target='c_T', target_wanted=0.0098, target_error=-1.0)
        unknown = dict(target='h_KS', target_wanted=-1.0, target_error=-1.0)
        for shown, part, not_said in (
            (view(**nothing), '', '.'),
            (view(spectrum=made.spectrum([9.0], 1.0, error=-1.0)), 'lambda_max 9.0000', '-1'),
            (view(status=status(progress=0.0, remaining_seconds=-1.0)), 't = 150.0', 'left|50.0 %'),
            (view(status=status(**asked)), 'error of c_T ?, wanted 0.0098', '-1'),
            (view(status=status(**unknown)), 'error of h_KS ?, wanted ?', '-1'),
            (view(diagnosis=diagnosis(2, 'disk full')), 'ERROR: disk full', 'WARN'),
            (view(diagnosis=diagnosis(stage='paused')), 'paused', 'averaging'),
            (view(is_gone=True), 'GONE: /hdlyap does not answer', 'finished'),
            (view(silence=63.0), 'no message for 1:03', 'GONE'),
            (view(is_master_gone=True), 'no master', 'GONE'),
            (view(status=finished, is_gone=True), 'finished', 'GONE|averaging|left'),
        ):
            text = line.GAP.join(said(shown))
            self.assertIn(part, text)
            self.assertNotRegex(text, not_said)

    def test_what_nobody_expects(self):
        """No number of a node, and no kind of another version, ends it."""
        numbers = [(float, each) for each in (float('inf'), float('nan'), -1.0, 1e300)]
        numbers += [(int, each) for each in (0, 77, 255)]
        names = 'status', 'cost', 'spectrum', 'steps'
        for (kind, number), name in itertools.product(numbers, names):
            with np.errstate(all='ignore'):
                shown = view()
                with_all(getattr(shown, name), kind, number)
                said(shown), told(shown)
        shown = view()
        shown.steps.steps[0].kind = 77
        self.assertIn('kind 77(1,0)', ' '.join(told(shown)))
        shown.status.sim_time = '\x1b[2J'
        fault = 'unexpected contents in a message of the node: '
        self.assertRegex(*said(shown), f'^{fault}ValueError')
        shown.spectrum.std_errors = []
        for step in shown.steps.steps:
            step.std_error = '1'
        news = News()
        self.assertRegex(told(shown, news)[-1], 'TypeError')

    def test_a_name_is_no_command(self):
        text, display = io.StringIO(), line.Display()
        with mock.patch('sys.stdout', text):
            display.say(['a\033[2Jb\r\x9bc'])
            display.show(['d\033[2J'])
        self.assertEqual(text.getvalue(), 'a?[2Jb ?c\nd?[2J\n')

    def test_only_the_line_has_no_steps(self):
        done = bags.tool('follow', '--line', '--steps')
        self.assertEqual(done.status, 2)
        self.assertIn('argument --steps: not allowed with argument --line', done.error)


class Told(unittest.TestCase):
    def test_everything(self):
        found = [made.step(made.run_info(), T, 1, 0, 36, 37), made.zero_modes(38)]
        half = np.linspace(9, 3, 37)
        both = made.spectrum([*half, *[0.0] * 6, *-half[::-1]], 50.0, pairing_error=2e-5)
        lines = told(view(spectrum=both, steps=made.steps(found)))
        self.assertEqual(lines[0], '/hdlyap  made  seed 1  run one')
        self.assertRegex(
            lines[1], 'N = 20, density 0.5, packing 0.3927, box 6.325 x 6.325, x periodic'
        )
        self.assertRegex(lines[2], r'averaged 50, h_KS 222.00\(80\), pairing error 2.0e-05')
        text = '\n'.join(lines[3:])
        for row in (
            r'\n  T\(1,0\) +36-37 +1.98 +2 +0.99346 +1.4895\(20\)\n',
            r'\n  c_T  1.400\(12\), misfit 1.2 \(c k \+ c2 k\^2 \+ c3 k\^3 over 3 wave numbers',
            r'\n  c_L  1.500\(20\) \(c k',
            r'\n  v    1.612\(23\), misfit 2.5 \(',
        ):
            self.assertRegex(text, row)

    def test_only_what_is_new(self):
        """A table when the averaged time has doubled, and when a step or an error is known."""
        now, news, shown = mock.Mock(return_value=0.0), News(), view()
        counts = []
        with mock.patch('time.monotonic', now):
            for wall, averaged, change in (
                (0, 50.0, None),
                (10, 60.0, None),
                (20, 70.0, ('resolved', True)),
                (21, 140.0, None),  # too soon
                (30, 140.0, None),
                (40, 10.0, None),  # the averages were reset
                (50, 11.0, ('run_id', 'two')),
                (60, 12.0, None),
            ):
                now.return_value = float(wall)
                shown.steps.averaged_time = averaged
                if change and change[0] == 'run_id':
                    shown.info.run_id = change[1]
                elif change:
                    setattr(shown.steps.steps[3], *change)
                counts.append(len(told(shown, news)) > 0)
        self.assertEqual(counts, [True, False, True, False, True, True, True, False])
        self.assertIn('  T(1,0) ', '\n'.join(news.of(shown, ended=True)))
        self.assertEqual(list(news.of(shown, ended=True)), [])

    def test_steps_that_nobody_listens_to(self):
        """Is said once of a run that has them."""
        news = News()
        unheard = view(steps=None, others=set())
        self.assertEqual(told(unheard, news)[-1], NOT_HEARD)
        self.assertEqual(told(unheard, news), [])
        for shown in (
            view(steps=None, others=set(), wanted=True),
            view(steps=None),
            view(steps=None, others=set(), info=made.run_info(observables=['spectrum'])),
            view(steps=made.steps([made.unresolved(made.run_info(), T, 1, 0, 2)])),
        ):
            self.assertEqual(len(told(shown)), 2)


class Heard(unittest.TestCase):
    def test_speed(self):
        speed = Speed()
        seen = [
            speed.add(made.Cost(wall_seconds=wall, sim_time=time))
            for wall, time in ((1, 10), (2, 30), (12, 130), (22, 130), (1, 5), (3, 15))
        ]
        self.assertEqual(seen, [None, 20.0, 10.0, 0.0, None, 5.0])

    def test_a_run_before_is_not_shown(self):
        shown = View()
        heard = dict(steps=made.steps([]), run_info=made.run_info(run_id='two'))
        heard.update(spectrum=made.spectrum([3.0], 1.0), status=status(run_id='two'), cost=cost())
        fill(shown, heard)
        self.assertEqual((shown.info.run_id, shown.status.run_id), ('two', 'two'))
        self.assertEqual((shown.steps, shown.spectrum, shown.cost), (None, None, None))

    def test_messages_are_unpacked_when_asked(self):
        class Counted(made.Spectrum):
            unpacked = 0

            def deserialize(self, data):
                Counted.unpacked += 1
                return super().deserialize(data)

        buffer = io.BytesIO()
        made.spectrum([3.0], 1.0).serialize(buffer)
        message = lazy(Counted)().deserialize(buffer.getvalue())
        self.assertEqual(Counted.unpacked, 0)
        self.assertEqual([message.unpacked().lambda_max for _ in range(2)], [3.0, 3.0])
        self.assertEqual(Counted.unpacked, 1)

    def test_damaged_bytes(self):
        """Are no message: what was known before is not shown for it."""
        shown = View()
        fill(shown, dict(status=lazy(RunStatus)().deserialize(b'1234').unpacked(), cost=cost()))
        self.assertEqual((shown.status, shown.cost), (None, None))
