"""Every field of every message beside what the core says by its public headers at that moment, in
the same process (witness.cpp). The rows of published.txt say what belongs together."""

import collections
import functools
import hashlib
import json
import os
import re

import genpy
import numpy as np

import harness
from hdlyap import msg, topics
from hdlyap.data import possible, space
from hdlyap.msg import LpPhase, Mode, Parameter
from hdlyap.runs.asked import text
from hdlyap.runs.program import HDLYAP

pytestmark = harness.UNDER_A_MASTER

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'published.txt')
ROUNDING = 1e-12  # relative to the largest, of sums of some hundred terms
Row = collections.namedtuple('Row', 'text code how place')  # place: among the names of its line

# ---- names that rows may use


class Said(dict):
    """What witness.cpp writes: its names are members, those with a dot members of members."""

    __getattr__ = dict.__getitem__


def of_json(said):
    out = Said()
    for name, value in said.items():
        *outer, inner = name.split('.')
        (out.setdefault(outer[0], Said()) if outer else out)[inner] = array(value)
    return out


def array(value):
    """Lists of numbers, or of as many numbers each, as arrays."""
    if isinstance(value, list) and not any(isinstance(one, (dict, str)) for one in value):
        if len({len(one) if isinstance(one, (list, np.ndarray)) else -1 for one in value}) <= 1:
            return np.array(value, float)
    return value


def each(count):
    """Elements without names."""
    return [Said() for _ in range(int(count))]


def pick(said, names):
    return [said[name] for name in names.split()]


def known(is_known, *values):
    return values if is_known else [np.nan] * len(values)


def shortest(value):
    """As a user would write it, exact to the last bit."""
    if isinstance(value, str):
        return value
    return next(text for text in (f'{value:.15g}', f'{value:.17g}') if float(text) == value)


def largest_error(errors):
    return max(errors) if len(errors) and min(errors) >= 0 else -1


def axis(core, vectors, k):
    """Component k of particle after particle, for one vector after the other: [particle][..]."""
    if np.size(vectors) == 0:
        return []
    vectors = np.atleast_2d(vectors)
    return vectors.reshape(len(vectors), int(core.N), -1)[:, :, int(k)].ravel()


def axes(core, vectors, first=0):
    """Three components, as far as space has them."""
    count = core.d if np.size(vectors) else 0
    return [axis(core, vectors, first + k) if k < count else [] for k in range(3)]


def momenta(core, p):
    """m v of particle after particle, from these over the roots of the masses."""
    return np.ravel(np.reshape(p, (int(core.N), -1)) * core.root[:, np.newaxis])


def turns(core, vectors):
    """Angles, or angular velocities."""
    return axis(core, vectors, core.coordinates - 1) / core.inertia**0.5


def pairs_of(step, fields):
    return fields[int(step.subspace)].dimension / 2 if step and step.kind == Mode.LP else 0


def first_slow(core, asked):
    """The column of the first vector of slow_vectors: of those of positive exponents, the last ones
    that are asked for, or all from the lowest T and LP steps on."""
    end = int(min(core.positive, core.vectors))
    if core.stage != msg.RunStatus.AVERAGING or 'steps' not in core:
        return end
    if asked.slow_vectors_count:
        return max(0, end - asked.slow_vectors_count)
    return int(min([end] + [col for col in core.lowest if col >= 0]))


def coefficients(core, steps, pairs, of_p):
    """Of the L or of the P fields, for each vector as many as a step may have pairs; 0 behind."""
    out = np.zeros((len(steps), int(2**core.d)))
    for k, count in enumerate(map(int, pairs)):
        if count:
            column = int(core.fields[int(steps[k].subspace)].column) + of_p * count
            out[k, :count] = core.coefficient[column : column + count, k]
    return out.ravel()


# of the rows that only the node has
UNITS = dict(slow_vectors_rate='1/s', pace='time units/s', checkpoint_interval='s', table='s')
INTEGER, REAL, WORD, SEED, EXPONENTS, INTERVAL, TEXT, SET = range(8)  # hd_parameter_kind
KINDS = {INTEGER: Parameter.INTEGER, REAL: Parameter.NUMBER, INTERVAL: Parameter.NUMBER}
TYPES = {list: Parameter.LIST, float: Parameter.NUMBER, int: Parameter.INTEGER}


def parameters(core, asked, made):
    """What each Parameter has: scene, those of the core's rows, those of the node alone; without a
    box none of a box."""
    absent = () if core.box[0] else space.OF_A_BOX
    rows = {row.name: row for row in core.rows if row.kind != SET and row.name not in absent}
    now = {**asked, **{change.name: float(change.value) for change in made}}
    others = [name for name in asked if name not in (*rows, *absent, 'scene', 'changes')]
    return [
        parameter(core, name, rows.get(name), now.get(name)) for name in ('scene', *rows, *others)
    ]


def parameter(core, name, row, asked):
    """row: the core's, if it has one; asked: None if only these particles have it and nobody gave
    it."""
    kind = KINDS.get(int(row.kind), Parameter.WORD) if row else TYPES.get(type(asked), 2)
    kind = Parameter.WORD if name == 'field_indices' else kind
    value = effect = written_as(kind, row.usual if asked is None else asked)
    if row and row.kind not in (SEED, EXPONENTS, TEXT) and name != 'particles':
        effect = written_as(kind, row.effect)
    if name == 'threads':
        effect = shortest(float(core.threads))
    if name == 'aspect' and row.effect * core.box[0] != core.box[1]:
        effect = shortest(core.box[1] / core.box[0])
    if name.startswith('boundary_'):
        effect = core.boundary['xyz'.index(name[-1])]
    of_node = Said(unit=UNITS.get(name, ''), as_before=name == 'observables', own=False)
    said = {key: (row or of_node)[key] for key in of_node}
    return Said(name=name, kind=kind, value=value, effect=effect, **said)


def written_as(kind, value):
    if isinstance(value, list) and kind == Parameter.LIST:
        return ', '.join(value)
    if kind == Parameter.WORD or isinstance(value, str):
        return str(value)
    return shortest(float(value))


FUNCTIONS = [each, pick, known, shortest, largest_error, pairs_of, first_slow, coefficients]
FUNCTIONS += [np.mean, np.where, np.ravel, np.split]
NAMES = {function.__name__: function for function in FUNCTIONS}
NAMES.update(nan=np.nan, inf=np.inf, pi=np.pi, TRACKED=LpPhase.TRACKED)
NAMES.update((name, getattr(Mode, name)) for name in ('NONE', 'ZERO', 'T', 'LP'))

# ---- the table


def read_table():
    """{message: {field: row}}, and the reasons of [untold]."""
    tables, rows = {}, {}
    with open(TABLE) as file:
        for line in filter(None, (line.partition('#')[0].rstrip() for line in file)):
            if line[0] == '[':
                rows = tables.setdefault(line.strip('[]'), {})
                continue
            names, how, text = re.fullmatch(
                r'([^\s:]+(?: [^\s:]+)*?)(:| =| ~| in) (.*)', line
            ).groups()
            code = None if 'untold' in tables else compile(text, names, 'eval')
            for place, name in enumerate(names.split()):
                if name in rows:
                    raise ValueError(f'{name}: twice')
                rows[name] = Row(text, code, how.strip(), place if ' ' in names else None)
    return tables, tables.pop('untold')


def is_close(numbers, wanted):
    scale = np.max(np.abs(wanted[np.isfinite(wanted)]), initial=0.0)
    return numbers.shape == wanted.shape and np.allclose(
        numbers, wanted, rtol=0.0, atol=ROUNDING * scale, equal_nan=True
    )


def agrees(numbers, how, wanted):
    wanted = as_numbers(wanted)
    if how == 'in':
        return wanted[0] <= numbers[0] <= wanted[1]
    return is_close(numbers, wanted) if how == '~' else np.array_equal(numbers, wanted, True)


def as_numbers(value):
    value = value.to_sec() if isinstance(value, genpy.Time) else value
    return np.atleast_1d(np.array(list(value) if isinstance(value, bytes) else value, float))


class Compared:
    """Messages of all scenes beside what the core said with them."""

    def __init__(self):
        self.tables, self.untold = read_table()
        self.wrong = {}  # {field: how the first one differs}
        self.told, self.unknown, self.rows = set(), set(), {}
        self.seen = collections.defaultdict(hashlib.sha1)  # {field: of all its values}

    def message(self, kind, message, core, given, element=(), number=0):
        """Goes through all fields. given: names of the scene; element, number: of a message within
        another one, the names there and its place."""
        env = {**NAMES, **core, **given, **dict(element), 'core': core, 'i': number}
        of_core = axis, axes, momenta, turns, parameters
        env.update((f.__name__, functools.partial(f, core)) for f in of_core)
        env['same'], done = env, {}
        rows = {**(self.tables['any'] if kind in self.tables else {}), **self.tables.get(kind, {})}
        for name in (name for name, row in rows.items() if row.how == ':'):
            env[name] = self.wanted(name, rows[name], env, done)
        for name, type_ in zip(message.__slots__, message._slot_types):
            value, base, full = getattr(message, name), type_.partition('[')[0], f'{kind}.{name}'
            if name not in rows:
                self.differs(full, 'has no row in published.txt')
                continue
            wanted = self.wanted(name, rows[name], env, done)
            self.rows[full] = rows[name]
            if base == 'std_msgs/Header':
                self.message('Header', value, core, given)
            elif base.startswith('hdlyap/'):
                self.list(full, base[len('hdlyap/') :], value, wanted, core, given)
            else:
                self.field(full, type_, value, rows[name], wanted)

    def wanted(self, name, row, env, done):
        """done: values of rows so far, of which several fields may be one line."""
        try:
            if row.text not in done:
                done[row.text] = eval(row.code, env)
            all_, is_named = done[row.text], isinstance(done[row.text], dict)
            return all_ if row.place is None else all_[name if is_named else row.place]
        except Exception as error:  # the core said nothing that such a message could be of
            self.differs(name, f'{row.text}: {error!r}')
            return ()

    def list(self, name, kind, those, wanted, core, given):
        """A field that holds messages."""
        self.told |= {name} if those else set()
        if len(those) != len(wanted):
            self.differs(name, f'{len(those)} of them, but {len(wanted)} are wanted')
        for k, (one, element) in enumerate(zip(those, wanted)):
            self.message(kind, one, core, given, element, k)

    def field(self, name, type_, value, row, wanted):
        is_text = type_.startswith('string')
        numbers = np.array([]) if is_text else as_numbers(value)
        told = np.isfinite(numbers) & (numbers != 0) & (numbers != -1)
        self.told |= {name} if (value if is_text else told.any()) else set()
        self.unknown |= {name} if np.any(np.isnan(numbers) | (numbers == -1)) else set()
        self.seen[name, type_].update(repr(value).encode() + b'\n')
        if not (value == wanted if is_text else agrees(numbers, row.how, wanted)):
            self.differs(name, f'{value!r:.200}, but {row.text} is {wanted!r:.200}')

    def differs(self, name, how):
        self.wrong.setdefault(name, how)

    def holes(self):
        """Rows that would pass if they were wrong: see [untold]. Those of no field, too."""
        for kind, rows in self.tables.items():
            names = {name for name, row in rows.items() if row.how != ':' and kind != 'any'}
            yield from {f'{kind}.{name}' for name in names} - set(self.rows)
        for name, row in self.rows.items():
            if name not in self.told and not name.endswith('.header'):
                yield name
            if re.search(r'\bnan\b|known\(|else -1|-1 if', row.text) and name not in self.unknown:
                yield name + '?'
        alike = collections.defaultdict(list)
        for (name, type_), digest in self.seen.items():
            alike[name.partition('.')[0], type_, digest.digest()].append(name.partition('.')[2])
        for (kind, *_), names in alike.items():
            if len(names) > 1:
                yield f'{kind}.{"=".join(names)}'


# ---- scenes

EVERY = 'spectrum modes steps lp_phases t_phases fields hydro structure covariant localization '
EVERY = (EVERY + 'fluctuations gas state').split()
REST = [name for name in EVERY if name != 'covariant']
TURNING = [name for name in REST if name != 'hydro']
WAVELESS = ['spectrum', 'covariant', 'localization', 'fluctuations']
# of few particles, most in boxes so long that steps are found at once
SHORT = dict(scene='a', equilibration=2.0, warmup=20.0, duration=40.0, report_interval=15.0)
SHORT.update(threads=1, observables=REST)
LOOKED_AT = dict(slow_vectors_rate=20.0, pace=80.0)  # some ten times
DISKS = dict(SHORT, scene='b', number=80, aspect=0.045, seed='2', max_wave_number=0.45)
DISKS.update(warmup=60.0, duration=250.0, report_interval=50.0, field_interval=100.0)
DISKS.update(target='lambda_max 0.001', changes=['80 report_interval=60', '90 field_interval=150'])
DISKS.update(phase_interval=1.0, fluctuation_time=1.5, accuracy=1e-7)
WALLS = dict(SHORT, number=40, aspect=14.0, boundary_x='reflecting', duration=1200.0)
WALLS.update(report_interval=400.0, fluctuation_time=6.0, phase_interval=6.0)
WALLS.update(field_interval=1000.0, observables=[name for name in TURNING if name != 'structure'])
SMALL = dict(SHORT, number=16, density=0.7, aspect=0.866, exponents='all_independent', interval=0.4)
SMALL.update(covariant_window=2.0, covariant_transient=10.0, covariant_sampling=0.5, pace=40.0)
SMALL.update(observables=EVERY, max_mode_number=1, covariant_memory=0.5, slow_vectors_count=9)
SMALL.update(slow_vectors_rate=20.0)
CIRCLE = dict(SHORT, **LOOKED_AT, container='circle', number=100, density=0.7)
CIRCLE.update(observables=[name for name in REST if name not in ('t_phases', 'hydro', 'structure')])
SPHERES = dict(SHORT, particles='spheres', number=48, density=0.5, aspect_z=6.0, aspect=1.0)
SPHERES.update(
    LOOKED_AT, max_mode_number=1, observables=EVERY, duration=100.0, report_interval=40.0
)
SPHERES.update(covariant_window=40.0, covariant_transient=20.0, covariant_sampling=20.0)
DUMBBELLS = dict(SHORT, particles='dumbbells', number=36, density=0.5, aspect=0.1, bond=0.4)
DUMBBELLS.update(
    LOOKED_AT, field_interval=100.0, exponents='all', max_mode_number=1, observables=TURNING
)
SOFT = dict(SHORT, particles='soft_disks', potential='power', number=36, density=0.2, aspect=0.05)
SOFT.update(max_mode_number=1, observables=TURNING, field_indices=[1, 66, 69])
BALLS = dict(SHORT, particles='soft_spheres', number=16, density=0.4, aspect=1.0, exponents=5)
BALLS.update(observables=['spectrum', 'gas', 'state'], duration=300.0, report_interval=100.0)
MIXTURE = dict(DISKS, second_fraction=0.4, second_diameter=0.8, second_mass=3.0)
CHAIN = dict(SHORT, particles='chain', number=8, duration=6000.0, beta=2.0)
CHAIN.update(report_interval=2000.0, fluctuation_time=40.0, observables=WAVELESS)
CHAIN.update(covariant_window=1500.0, covariant_transient=20.0, covariant_sampling=100.0)
TELLING = dict(SHORT, particles='telling_chain', number=8, exponents=2, duration=3000.0)
TELLING.update(report_interval=1000.0, observables=['spectrum', 'averages', 'state'])
RING = dict(SHORT, particles='ring', number=4, exponents='all', observables=['spectrum'])
# so short that the sum of exponents is known, and a few of its errors
SHEAR = dict(SHORT, number=12, density=0.4, aspect=0.5, boundary_y='shearing', shear_b=2.0)
SHEAR.update(exponents='all')
SHEAR.update(observables=['spectrum', 'steps', 'gas'], duration=600.0, report_interval=200.0)
ALONE = dict(SHORT, number=20, exponents='none', observables=['gas', 'state'], duration=5.0)
FEW = dict(
    SHORT, number=30, aspect=0.1, exponents=3, observables=['spectrum', 'steps', 'covariant']
)
FEW.update(covariant_window=1.0, covariant_transient=10.0, covariant_sampling=0.25, duration=80.0)
FEW.update(threads=2, report_interval=1.0)


def scenes(folder):
    """Name, parameters, and how the scene is run."""
    kept = os.path.join(folder, 'kept')
    chain = dict(CHAIN, checkpoint=kept, checkpoint_interval=300.0)
    resumed = dict(resume=kept, duration=6100.0, changes=['6050 report_interval=20'])
    resumed.update(observables=WAVELESS, slow_vectors_rate=5.0)
    own = dict(program='hdlyap_own_node')
    return [
        ('disks', DISKS, {}),
        ('mixture', MIXTURE, {}),
        ('walls', WALLS, {}),
        ('small', SMALL, dict(rare=True)),
        ('circle', CIRCLE, {}),
        ('spheres', SPHERES, {}),
        ('dumbbells', DUMBBELLS, dict(rare=True)),
        ('soft_disks', SOFT, {}),
        ('soft_spheres', BALLS, {}),
        ('chain', chain, own),
        ('resumed', resumed, dict(own, before=CHAIN)),
        ('ring', RING, own),  # not symplectic
        ('telling', TELLING, own),
        ('shear', SHEAR, {}),  # walls that are not symplectic
        ('few', FEW, {}),
        ('alone', ALONE, {}),  # no vectors
    ]


class Published(harness.Case):
    def setUp(self):
        self.compared, self.folder = Compared(), self.new_folder()

    def run_of(self, name, params, program=None, rare=False):
        """{topic: messages} of a run, what the core said with them, and what the node logged."""
        path = os.path.join(self.folder, name)
        env = {'WITNESS': path, 'LD_PRELOAD': harness.program('hdlyap_witness.so')}
        env.update({'WITNESS_RARE': '1'} if rare else {})
        # who looks at slow_vectors changes when the run measures, by the clock
        names = [
            *params['wait_for_subscribers'],
            *['slow_vectors'] * ('slow_vectors_rate' in params),
        ]
        listeners = {topic: self.listen(topic) for topic in names}
        node = self.start(params, command=program and [harness.program(program)], **env)
        messages = {topic: listener.all_of(node) for topic, listener in listeners.items()}
        self.ends(node)
        with open(path) as file:
            said = [json.loads(line, object_hook=of_json) for line in file]
        return messages, said, node

    def scene(self, name, params, before=(), **how):
        """Compares all messages of a run. before: parameters of the run that it resumes."""
        names = ['run_info', *params['observables'], 'status', 'cost']
        params = dict(params, wait_for_subscribers=names)
        messages, said, node = self.run_of(name, params, **how)
        own = {name for one in HDLYAP.own().values() for name in one}
        usual = {name: value for name, value in harness.defaults().items() if name not in own}
        asked = Said(usual, **{**dict(before), **params})
        warnings = [re.split(r'\]: |\x1b', line)[-2] for line in node.lines('which steps need')]
        run_id = messages['run_info'][-1].run_id
        messages = {  # without those that a node before it has latched
            topic: [one for one in those if one.run_id == run_id]
            for topic, those in messages.items()
        }
        names = dict(run_id=run_id, warning=''.join(warnings[:1]))
        info = messages['run_info'][-1]
        for topic, those in messages.items():
            for message, core in self.beside(topic, those, said):
                possible.check(message, info)  # tools do not refuse it
                given = {**names, **given_at(asked, params, core)}
                self.compared.message(topics.TYPES[topic].__name__, message, core, given)

    def beside(self, topic, those, said):
        """Each message, which roscpp counts, with what the core said of it. A latched one may come
        twice, if it is sent while the subscriber connects."""
        kind = re.sub(r'(?<=.)(?=[A-Z])', '_', topics.TYPES[topic].__name__).lower()
        found = [core for core in said if core.type == 'hdr_' + kind]
        by_seq = {message.header.seq: message for message in those}
        if topic not in topics.ASIDE:  # of those some may be lost
            self.assertEqual(sorted(by_seq), list(range(len(found))), topic)
        return [(message, found[seq]) for seq, message in by_seq.items()]

    def test_every_field(self):
        wrong = ['no scene has ~' + one for one in {*harness.OBSERVABLES, 'covariant'} - {*EVERY}]
        for scene, params, how in scenes(self.folder):
            self.compared.wrong.clear()
            self.scene(scene, params, **how)
            wrong += [f'{scene}: {name}: {how}' for name, how in self.compared.wrong.items()]
        self.assertEqual(wrong, [], "\n".join(wrong))
        self.assertLessEqual(set(self.compared.holes()), set(self.compared.untold))


def given_at(asked, params, core):
    """Parameters as they are when the core says this, and the changes that are made by then."""
    changes = [re.fullmatch(r'(\S+) (\w+)=(.*)', text).groups() for text in asked.changes]
    made = [
        Said(name=name, before=f'{asked[name]:g}', value=value)
        for time, name, value in changes
        if float(time) <= core.get('change_time', core.time)
    ]
    effect = {row.name: row.effect for row in core.get('rows', ())}
    given = Said(asked, **{**effect, **params})
    given.update((change.name, float(change.value)) for change in made)
    written = [f'{name}={text(value)}' for name, value in sorted(params.items())]
    return dict(asked=asked, given=given, made=made, written=written)
