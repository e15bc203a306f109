"""follow: what its screen shows of made messages."""

import io
import itertools
import unittest

import numpy as np

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

import golden
import made
from hdlyap.msg import Cost, LpPhase, RunStatus
from made import LP, T
from hdlyap.follow import dashboard, line, panels
from hdlyap.follow.layout import length, wrapped
from hdlyap.follow.watch import Speed, View, fill, lazy
from hdlyap.glyphs import Glyphs

SIZES = (80, 24), (120, 40), (200, 60), (60, 15), (30, 5), (7, 2), (1, 1)
FEW = SIZES[:2] + SIZES[-1:]
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
        phases=made.lp_phases(info, found, 150.0, began=100.0),
        diagnosis=diagnosis(),
        others=set(OBSERVED),
    )
    for name, value in {**values, **fields}.items():
        setattr(shown, name, value)
    return shown


def drawn(shown, size=(80, 24), plain=False):
    return [
        ''.join(text for text, _ in spans) for spans in dashboard.lines(shown, size, Glyphs(plain))
    ]


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


class Screens(unittest.TestCase):
    def text(self, shown, size=(80, 24), **options):
        """All of it fits."""
        lines = drawn(shown, size, **options)
        self.assertLessEqual(len(lines), size[1])
        self.assertLessEqual(max(map(len, lines)), size[0])
        return '\n'.join(lines)

    def says(self, text, *parts):
        for part in parts:
            self.assertIn(part, text)

    def test_everything_is_there(self):
        """Each number is another one."""
        info = made.run_info(observables=OBSERVED, duration=200.0)
        found = [
            made.step(info, T, 1, 0, 36, 37),
            made.step(info, LP, 1, 1, 32, 35, multiplicity=3.72),
            made.unresolved(info, LP, 0, 1, 4),
        ]
        half = np.linspace(9, 3, 37)
        message = made.lp_phases(info, found, 150.0, began=100.0, modulations=(1,))
        message.phases[1].state = LpPhase.WEAK
        message.phases[2].a *= 0.5
        shown = view(
            info=info,
            status=status(target='c_T', target_error=0.0123, target_wanted=0.0098),
            cost=cost(events_per_second=3.4e5, covariant_seconds=1.5, publish_seconds=4.5),
            spectrum=made.spectrum([*half, *[0.0] * 6, *-half[::-1]], 50.0, pairing_error=2e-5),
            steps=made.steps([*found, made.zero_modes(38)]),
            phases=message,
            diagnosis=diagnosis(1, 'disks overlap'),
            others={'spectrum'},
        )
        shown.spectrum.std_errors = [0.01 * k for k in range(1, 81)]
        golden.check(self, 'screen.txt', self.text(shown, (100, 40)) + '\n')
        self.says(self.text(shown), 'c_T 1.400(12), misfit 1.2   c_L 1.500(20)   v 1.612(23), misf')
        self.assertTrue(self.text(shown, plain=True).isascii())

    def test_glyphs(self):
        hands = [Glyphs().dial(turn) for turn in (0, 0.125, 0.25, 0.5, 0.75, 0.94, 0.99)]
        self.assertEqual(''.join(hands), '→↗↑←↓→→')
        shares = 0, 0.5, 0.53125, 1, 7, -1, float('nan')
        bars = '    ', '██  ', '██▏ ', '████', '████', '    ', '    '
        self.assertEqual(tuple(Glyphs().bar(share, 4) for share in shares), bars)
        self.assertEqual(Glyphs(plain=True).bar(0.6, 4, rest=True), '##..')

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

    def test_what_is_shown(self):
        """Of what is known, and of what is not."""
        of_spectrum = made.run_info(observables=['spectrum'])
        nothing = dict.fromkeys(
            ('status', 'cost', 'spectrum', 'steps', 'phases', 'diagnosis', 'speed')
        )
        unknown_run = view(**nothing)
        unknown_run.info = None
        unheard = dict(steps=None, phases=None, others=set())
        unfound = made.steps([made.unresolved(of_spectrum, T, 1, 0, 2)])
        unknown = view(spectrum=made.spectrum([9.0, 3.0], 1.0, error=-1.0))
        unknown.steps.c_t_error = -1.0
        unknown.steps.c_l = unknown.cost.condition = float('nan')
        unknown.phases.phases[0].a = unknown.phases.phases[1].omega_error = float('nan')
        finished = view(
            status=status(stage=RunStatus.FINISHED), is_gone=True, diagnosis=diagnosis()
        )
        asked = dict(target='c_T', target_wanted=0.0098, target_error=-1.0)
        of_target, endless = status(**asked), status(progress=0.0, remaining_seconds=-1.0)
        for shown, said, not_said in (
            (unknown, ['lambda_max 9.00000 ', 'sum of exponents 12.00000 '], '-1\\.0'),
            (unknown, ['c_T 1.40000, ', 'c_L -', 'condition nan'], '-1\\.0'),
            (view(**nothing), ['waiting for its first word'], 'lambda|simulated'),
            (unknown_run, ['/hdlyap'], 'seed'),
            (view(**unheard), ['steps: computed only while somebody listens; key m:'], 'T\\(1,0'),
            (view(**unheard), ['m compute steps and phases'], 'no more'),
            (view(info=of_spectrum, **unheard), ['lambda_max'], 'steps|LP phases'),
            (view(steps=unfound), ['steps: none resolved yet'], 'T\\(1,0'),
            (
                view(phases=made.lp_phases(of_spectrum, [], 100)),
                ['no LP step resolved yet'],
                '2 pi',
            ),
            (view(spectrum=made.spectrum([9.0], 50.0), **unheard), ['lambda_max 9.0'], 'sum|h_KS'),
            (view(status=endless), ['simulated 150.0'], ' left|50.0 %'),
            (view(status=of_target), ['c_T to ? of 0.0098'], 'to -1'),
            (view(diagnosis=diagnosis(2, 'disk full')), ['ERROR  disk full'], 'WARN'),
            (view(diagnosis=diagnosis(stage='paused')), ['paused  █'], 'averaging  █'),
            (view(is_gone=True), ['GONE  /hdlyap does not answer'], 'finished'),
            (view(silence=63.0), ['no message for 1:03'], 'GONE'),
            (view(is_master_gone=True), ['no master'], 'GONE'),
            (finished, ['finished  █', 'the run has finished'], 'GONE|averaging'),
        ):
            text = self.text(shown)
            self.says(text, *said)
            self.assertNotRegex(text, not_said)

    def test_values_of_the_paper_where_there_is_room(self):
        paper = view(info=made.paper_info(), spectrum=made.spectrum(np.linspace(6, 1, 1557), 50.0))
        self.says(self.text(paper, (120, 40)), 'deviation')
        self.assertNotIn('deviation', self.text(paper))

    def test_every_size(self):
        info = made.run_info(observables=OBSERVED)
        found = [made.step(info, T, n, 1, 2 * n, 2 * n + 1) for n in range(1, 40)]
        many = view(steps=made.steps(found))
        for size in SIZES:
            for shown in (view(), view(is_gone=True, is_master_gone=True, status=None)):
                self.text(shown, size)
            self.says(self.text(many, size), 'averag'[: size[0]])
        self.says(self.text(many, (80, 18)), '  36 more\n')
        self.assertNotIn('more\n', self.text(many, (200, 80)))

    def test_nothing_is_cut(self):
        """From 80 columns on: long lines go on below, names of a shared set are those of the rows
        below it, the paper's values stand where there is room."""
        info = made.paper_info()
        info.run_id, info.observables = '20261122T194504.100733Z-17630-1', OBSERVED
        shared = dict(set=1, first_index=1500, last_index=1549, members=12, sharing=2)
        shown = view(
            node='/laboratory_two/of_a_long_name/hdlyap',
            info=info,
            status=status(remaining_seconds=96961.0),
            spectrum=made.spectrum(np.linspace(6, 1, 1557), 50.0),
            steps=made.steps(
                [made.step(info, T, 1, 0, 1556, 1557)]
                + [made.step(info, T, 10, n, 1, 2, **shared) for n in range(10, 22)]
            ),
            phases=made.lp_phases(
                info, [made.step(info, LP, 10, n, 1200, 1203) for n in range(10, 40)], 150.0
            ),
            diagnosis=diagnosis(
                1,
                'errors of the smallest exponents do not fall: 0.0034 after 1e+03 '
                'time units of averaging, 0.0035 after 9e+02; a subscriber of /hdlyap/spectrum '
                'is 3 s behind',
            ),
        )
        said = 'seed 1 run 20261122T194504.100733Z-17630-1', ' 50.0 % 26:56:01 left', 'T(10,21)'
        said += 'WARN ' + shown.diagnosis.message, 'mixing'
        self.says(' '.join(self.text(shown, (400, 400)).split()), *said)
        for width in range(80, 131, 3):
            for height in (24, 400):
                lines = dashboard.lines(shown, (width, height), Glyphs())
                self.assertLessEqual(max(map(length, lines)), width)
            self.says(' '.join(self.text(shown, (width, 400)).split()), *said)

    def test_shared_names(self):
        self.assertEqual(panels.joined(['T(1,0)', 'T(0,1)'], 13), 'T(1,0)+T(0,1)')
        self.assertEqual(panels.joined(['T(1,0)', 'T(0,1)', 'T(1,1)'], 13), 'T(1,0)+2 more')
        self.assertEqual(panels.joined(['T(1,0)', 'T(0,1)'], 2), 'T(1,0)')

    def test_wrapping(self):
        """In the styles that it had."""
        line = [('  one two', 'strong'), (' three  four', 'T')]
        for whole, width, lines in (
            (line, 21, ['  one two three  four']),
            (line, 18, ['  one two three', '    four']),
            (line, 10, ['  one two', 'three', 'four']),
            ([('abcdef', '')], 4, ['abcd', 'ef']),
            ([('abcd  ', '')], 4, ['abcd']),
        ):
            found = wrapped(whole, width)
            self.assertEqual([''.join(text for text, _ in one) for one in found], lines)
        styles = [{text: style for text, style in one if text.strip()} for one in wrapped(line, 10)]
        self.assertEqual({*styles[0].values()}, {'strong'})
        self.assertEqual({*styles[1].values(), *styles[2].values()}, {'T'})

    def test_what_nobody_expects(self):
        """No number of a node, and no kind of another version, takes the screen away."""
        numbers = [(float, each) for each in (float('inf'), float('nan'), -1.0, 1e300)]
        numbers += [(int, each) for each in (0, 77, 255)]
        names = 'status', 'cost', 'spectrum', 'steps', 'phases'
        for (kind, number), name in itertools.product(numbers, names):
            with np.errstate(all='ignore'):
                shown = view()
                with_all(getattr(shown, name), kind, number)
                for size in FEW:
                    self.text(shown, size)
                line.parts(shown)
        shown = view()
        shown.steps.steps[0].kind = 77
        self.says(self.text(shown), 'kind 77(1,0)')

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

    def test_one_line(self):
        shown = view(spectrum=made.spectrum([9.0, 3.0], 50.0))
        shown.spectrum.std_errors = [0.01, 0.03]
        said = ['averaging', '50.0 %', 't = 150.0', '1:05 left', 'lambda_max 9.0000 +- 0.0100']
        said += ['interval 2.37 (conditioning), repairs 4', 'classification 5 % of the time']
        self.assertEqual(line.parts(shown), said)

    def test_nonsense(self):
        """One line, and the key that ends it."""
        spectrum = made.spectrum([3.0], 50.0)
        spectrum.std_errors = []
        said = 'unexpected contents in a message of the node: IndexError: '
        for size in SIZES:
            text = self.text(view(spectrum=spectrum), size)
            self.assertTrue(text.startswith(said[: min(size[0], 4)]))
        self.says(self.text(view(spectrum=spectrum)), said, '\nq quit')
        shown = view(spectrum=None, cost=cost(modes_seconds=1.0, wall_seconds=0.0))
        self.assertEqual(line.parts(shown)[-1], 'interval 2.37 (conditioning), repairs 4')
        shown.status.sim_time = '\x1b[2J'
        self.assertEqual(len(line.parts(shown)), 1)
        self.assertRegex(
            line.parts(shown)[0], '^unexpected contents in a message of the node: ValueError'
        )

    def test_a_name_is_no_command(self):
        for width in (80, 5):
            told = wrapped([('a\033[2Jb\r\x9bc', '')], width)
            self.assertEqual(
                ''.join(''.join(text for text, _ in part) for part in told), 'a?[2Jb ?c'
            )


if __name__ == '__main__':
    unittest.main()
