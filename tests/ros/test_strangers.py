"""Bags of strangers: whatever a field says, there is an answer within seconds, and it is never a
traceback nor a fault of hdlyap. What a node can say is drawn; all else is refused in a line with
the field, its value and what is allowed."""

import copy
import io
import re
import time
from unittest import mock

import numpy as np

import hdlyap
import made
import made_fields
from bags import tool
from hdlyap.data import possible, reader
from hdlyap.data.reader import RecordingError
from hdlyap.msg import Change, CovariantAngle, Hydro, HydroMode, Mode, Modes, State
from made import LP, T
from test_data_joined import HALF, numbered
from test_data_tools import Tools
from test_structure import message as structure

BOND = 'parameters[%d].effect' % len(made.PARAMETERS)  # of dumbbells
DURATION = 'parameters[%d].effect' % list(made.PARAMETERS).index('duration')
SECONDS = 10.0  # of a processor for an answer; nested aliases took 100, an index of 4e9 took 90
INTEGERS = 0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**64 - 1
REALS = float('nan'), float('inf'), -float('inf'), -1.0, 0.0, 1e-320, 1e100, 1e308
ALIASES = '{a: &a [x,x], b: &b [*a,*a,*a,*a,*a,*a,*a,*a], c: &c [*b,*b,*b,*b,*b,*b,*b,*b]}'
TEXTS = '', '$', '\\', '$x$', '\x1b[2J', 'a' * 10000, ALIASES, '2^9'
LIMITS = dict(bool=(0, 1), uint8=(0, 255), uint32=(0, 2**32 - 1), uint64=(0, 2**64 - 1))
LIMITS.update(int32=(-(2**31), 2**31 - 1))


def of_hydro(step):
    many = (
        HydroMode(step=0, kind=step.kind, nx=1, modulation=bits, index=step.first_index)
        for bits in (0, 1)
    )
    return Hydro(run_id='one', sim_time=150.0, responses=list(many))


def every_kind():
    """A run with a message of each type that a bag has, at its end."""
    info = made.run_info(particles='dumbbells', inertia=0.14, own=['bond=0.25', 'inertia=disks'])
    info.coordinates, info.vectors, info.sites = 3, 37, [-0.125, 0.125]
    info.kind_numbers, info.kind_diameters, info.kind_masses = [12, 8], [1.0, 1.4], [1.0, 2.0]
    found = [made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)]
    turned = dict.fromkeys(('angle', 'spin', 'dq_angle', 'dp_angle'), [0.1] * 20)
    x, y, px, py = made_fields.disks(info)
    state = dict(x=x, y=y, px=px, py=py, angle=[0.1] * 20, spin=[0.2] * 20)
    modes = [Mode(index=k, kind=T, nx=1, wave_number=1.0, weight=0.9) for k in (36, 37)]
    covariant = made.covariant(HALF, weights=[made.covariant_weight(found[0], 37)])
    counts = dict(smallest_counts=[3, 4, 0, 1], all_counts=[5, 6, 7, 8])
    covariant.angles = [CovariantAngle(spaces=1, mean=0.3, std_error=0.1, least=0.2, **counts)]
    covariant.orders = [made.GrowthOrder(time=5.0, count=7)]
    for name in ('violations', 'domination_violations'):
        setattr(covariant.orders[0], name, [0.5] * 36)
    pairs = [(LP, 1, 0, [32, 33]), (T, 1, 0, [36, 37])]
    unseen = made.zero_modes()
    course = [
        one
        for t in (30.0, 50.0)
        for one in (
            made.spectrum(HALF, t),
            made.steps([*found, unseen], t),
            Modes(run_id='one', sim_time=100 + t, averaged_time=t, samples=5, modes=modes),
            made.status(100 + t),
            made.cost(100 + t),
            made.lp_phases(info, found, 100 + t, began=100),
            made.t_phases(found, 100 + t, began=100),
            State(run_id='one', sim_time=100 + t, **state),
            structure(info, 100 + t, found),
            of_hydro(found[0]),
        )
    ]
    course += [made_fields.mode_field(info, one, **turned) for one in found]
    course += [covariant, made.localization([0.5] * 37), made.gas(), made.averages()]
    return [info, *course, made.fluctuations([0.5] * 37, pairs)]


def places(message):
    """Yields (message or element of a list in it, the same in a deep copy of the whole, name, type)
    of its fields; of lists the first element."""
    for name, kind in zip(message.__slots__, message._slot_types):
        value = getattr(message, name)
        if kind.startswith('hdlyap/'):
            for k, element in enumerate(value if name == 'parameters' else value[:1]):
                yield from ((f'{name}[{k}].{path}', one) for path, one in places(element))
        elif name not in ('header', 'run_id'):
            yield name, kind


def odd_values(value, kind):
    base = kind.partition('[')[0]
    odd = TEXTS if base == 'string' else REALS if base.startswith('float') else INTEGERS
    if base in LIMITS:
        low, high = LIMITS[base]
        odd = sorted({min(max(one, low), high) for one in (*odd, low)})
    if not kind.endswith('[]'):
        return odd
    value = list(value)
    return [[], value + value[:1], value[:-1], *([one] + value[1:] for one in odd)]


def within(message, path):
    """The message that has the field at a path, and its name."""
    *lists, name = path.split('.')
    for one in lists:
        slot, place = re.fullmatch(r'(\w+)\[(\d+)\]', one).groups()
        message = getattr(message, slot)[int(place)]
    return message, name


def damaged(message, path, value):
    message = copy.deepcopy(message)
    inside, name = within(message, path)
    is_bytes = isinstance(getattr(inside, name), bytes)
    setattr(inside, name, bytes(value) if is_bytes else value)
    return message


def cases():
    """Yields (place in the run, path of a field, odd value)."""
    messages = every_kind()
    last = {message._type: place for place, message in enumerate(messages)}
    for place in last.values():
        for path, kind in places(messages[place]):
            odd = odd_values(getattr(*within(messages[place], path)), kind)
            if path.endswith('].effect'):
                odd = [*odd, *map(str, REALS)]
            yield from ((place, path, value) for value in odd)


class Strangers(Tools):
    save = staticmethod(
        lambda figure, folder, name: []
    )  # figures are made, and not drawn to the end
    seconds = SECONDS

    def is_answered(self, messages, name='plot', *arguments):
        """Within seconds; returns what it said."""
        bag, began = self.write(messages, 'odd'), time.process_time()
        with mock.patch('bags.save_nothing', self.save):
            done = tool(name, bag, *arguments)
        self.assertLess(time.process_time() - began, self.seconds)
        for said in ('fault of hdlyap', 'unexpected contents', 'Traceback', 'cannot be drawn'):
            self.assertNotIn(said, done.error)
        self.assertLessEqual(done.error.count('\n'), 1)
        return done.error

    def is_possible(self, message, path, info):
        """Otherwise its refusal names the field."""
        try:
            possible.check(message, info)
            return True
        except possible.Damaged as error:
            inside, name = within(message, path)
            name = f'{name}|{re.escape(inside.name)}' if path.startswith('parameters') else name
            said = rf'^hdlyap/\w+: .*({name}|elements|aspect|vectors|first|no )'
            self.assertRegex(str(error), said)
            return False

    def are_answered(self, rounds):
        """Odd values of many fields at once, in as many bags as there are rounds; what is
        impossible is refused by name."""
        whole, bags = numbered(every_kind()), {}
        for case, (place, path, value) in enumerate(cases()):
            messages = bags.setdefault(case % rounds, list(whole))
            odd = damaged(messages[place], path, value)
            if self.is_possible(odd, path, messages[0]):
                messages[place] = odd
        arguments = 'plot', '--out', self.out, '--csv', self.path('csv')
        began = time.process_time()
        with mock.patch('bags.save_nothing', self.save):
            tool(arguments[0], self.write(whole), *arguments[1:])
        self.seconds = SECONDS + 2 * (time.process_time() - began)  # a busy machine draws for long
        for number, messages in bags.items():
            with self.subTest(number=number):
                self.is_answered(messages, *arguments)


class Together(Strangers):
    def test_all_that_is_possible(self):
        self.are_answered(rounds=6)

    def test_what_has_happened(self):
        """Each of these took minutes, or was called a fault of hdlyap."""
        whole = every_kind()
        kinds = [message._type for message in whole]
        film = self.path('a') + '.mp4'
        for kind, path, values, said in (
            ('RunInfo', BOND, ['nan', '-inf', '1e999', '[', ALIASES], 'bond = .*: must be '),
            ('RunInfo', DURATION, ['nan', ''], 'duration = .*: must be '),
            ('RunInfo', 'sites', [[float('nan')], 9 * [0.1]], 'sites = .*: must be '),
            ('RunInfo', 'kind_numbers', [[12, 9], 9 * [2]], 'kind_.*: must be '),
            ('RunInfo', 'kind_masses', [[1.0, 0.0], [1.0, 1e10]], 'kind_masses = .*must be '),
            ('RunInfo', 'coordinates', [0], 'coordinates = 0: must be from 1 to 1000'),
            ('RunInfo', 'zero_exponents', [2**31], 'zero_exponents = 2147483648: must be from 0'),
            (
                'Steps',
                'steps[0].last_index',
                [4 * 10**9],
                'last_index = 4000000000: must be from',
            ),
            ('ModeField', 'modulation', [[0], [0, 1, 2]], r'elements: must be \d'),
        ):
            place = len(kinds) - 1 - kinds[::-1].index(f'hdlyap/{kind}')
            for value in values:
                odd = [*whole[:place], damaged(whole[place], path, value), *whole[place + 1 :]]
                for name, *arguments in (('plot', '--out', self.out), ('movie', '--out', film)):
                    if name == 'movie' and kind == 'ModeField':
                        continue  # without pairs
                    error = self.is_answered(odd, name, *arguments)
                    self.assertRegex(error, rf'^hdlyap {name}: .*odd.bag: damaged: hdlyap/\w+: ')
                    self.assertRegex(error, said)

    def test_changes(self):
        """Which hdlyap repeat makes again."""
        for change, said in (
            (Change(name='nothing', before='1'), 'changes: nothing: must be a parameter'),
            (Change(name='pace', before='x'), 'changes: x before: must be a float'),
        ):
            info = made.run_info(changes=[change])
            self.assertIn(said, self.is_answered([info], 'repeat'))

    def test_own_numbers(self):
        info = made.run_info(own=['potential=wca', 'time_step=1e-05', 'cut=2', 'name=2e'])
        run = hdlyap.load(self.write([info]))
        self.assertEqual(run.own, dict(potential='wca', time_step=1e-5, cut=2, name='2e'))
        self.assertIsInstance(run.own['time_step'], float)

    def test_is_checked_when_it_is_read(self):
        """Of each type."""
        messages = numbered(every_kind())
        for message in messages[1:]:
            message.sim_time = float('nan')
            packed = io.BytesIO()
            message.serialize(packed)
            with self.assertRaisesRegex(RecordingError, 'a.bag: damaged: .*: sim_time = nan'):
                reader.Packed('a.bag', message._type, packed.getvalue(), None).message(np)
