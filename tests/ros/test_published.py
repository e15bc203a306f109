#!/usr/bin/env python3
"""Every field of every message beside what the core says by its public headers at that moment, in
the same process (witness.c). The rows of published.txt say what belongs together."""

import collections
import hashlib
import json
import os
import re

import genpy
import numpy as np

import harness
from hdlyap import msg, topics
from hdlyap.msg import LpPhase, Mode

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'published.txt')
ROUNDING = 1e-12  # relative to the largest, of sums of some hundred terms
Row = collections.namedtuple('Row', 'text how code')

# ---- names that rows may use


class Said(dict):
    """What witness.c writes: its names are members."""

    __getattr__ = dict.__getitem__


def of_json(said):
    return Said((name, array(value)) for name, value in said.items())


def array(value):
    """Lists of numbers, or of as many numbers each, as arrays."""
    if isinstance(value, list) and not any(isinstance(one, (dict, str)) for one in value):
        if len({len(one) if isinstance(one, (list, np.ndarray)) else -1 for one in value}) <= 1:
            return np.array(value, float)
    return value


def each(count):
    """Elements without names."""
    return [Said() for _ in range(int(count))]


def shortest(value):
    """As a user would write it, exact to the last bit."""
    if isinstance(value, str):
        return value
    return next(text for text in (f'{value:.15g}', f'{value:.17g}') if float(text) == value)


def largest_error(errors):
    return max(errors) if len(errors) and min(errors) >= 0 else -1


def component(vectors, k, core):
    """Component k of particle after particle, for one vector after the other: [particle][..]."""
    vectors = np.atleast_2d(vectors)
    return vectors.reshape(len(vectors), int(core.N), -1)[:, :, int(k)].ravel()


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


def coefficients(core, steps, of_p):
    """Of the L or of the P fields, for each vector as many as a step may have pairs; 0 behind."""
    out = np.zeros((len(steps), int(2**core.d)))
    for k, pairs in enumerate(int(pairs_of(step, core.fields)) for step in steps):
        if pairs:
            column = int(core.fields[int(steps[k].subspace)].column) + of_p * pairs
            out[k, :pairs] = core.coefficient[column : column + pairs, k]
    return out.ravel()


NAMES = dict(
    nan=np.nan, inf=np.inf, pi=np.pi, mean=np.mean, where=np.where, ravel=np.ravel, each=each
)
NAMES.update(shortest=shortest, largest_error=largest_error, pairs_of=pairs_of)
NAMES.update(first_slow=first_slow, coefficients=coefficients, TRACKED=LpPhase.TRACKED)
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
            name, how, text = re.fullmatch(r'(\S+?)(:| +=| +~| +in) +(.*)', line).groups()
            if name in rows:
                raise ValueError(f'{name}: twice')
            rows[name] = Row(text, how.strip(), None)
    untold = {name: row.text for name, row in tables.pop('untold').items()}
    for rows in tables.values():
        for name, row in rows.items():
            rows[name] = row._replace(code=compile(row.text, name, 'eval'))
    return tables, untold


def is_same(numbers, wanted):
    return np.array_equal(numbers, np.atleast_1d(np.array(wanted, float)), equal_nan=True)


def is_close(numbers, wanted):
    wanted = np.atleast_1d(np.array(wanted, float))
    scale = np.max(np.abs(wanted[np.isfinite(wanted)]), initial=0.0)
    return numbers.shape == wanted.shape and np.allclose(
        numbers, wanted, rtol=0.0, atol=ROUNDING * scale, equal_nan=True
    )


def is_between(numbers, wanted):
    return wanted[0] <= numbers[0] <= wanted[1]


HOW = {'=': is_same, '~': is_close, 'in': is_between}


def as_numbers(value):
    if isinstance(value, genpy.Time):
        return np.array([value.to_sec()])
    return np.atleast_1d(np.array(list(value) if isinstance(value, bytes) else value, float))


class Compared:
    """Messages of all scenes beside what the core said with them."""

    def __init__(self):
        self.tables, self.untold = read_table()
        self.wrong = {}  # {field: how the first one differs}
        self.told, self.unknown = set(), set()
        self.seen = collections.defaultdict(hashlib.sha1)  # {field: of all its values}

    def message(self, kind, message, core, given, element=(), number=0):
        """Goes through all fields. given: names of the scene; element, number: of a message within
        another one, the names there and its place."""
        env = {**NAMES, **core, **given, **dict(element), 'core': core, 'i': number}
        env['of'] = lambda vectors, k: component(vectors, k, core)
        rows = self.tables.get(kind, {})
        for name in (name for name, row in rows.items() if row.how == ':'):
            env[name] = self.wanted(f'{kind}.{name}', rows[name], env)
        for name, type_ in zip(message.__slots__, message._slot_types):
            value, base = getattr(message, name), type_.partition('[')[0]
            if name not in rows:
                self.differs(f'{kind}.{name}', 'has no row in published.txt')
                continue
            wanted = self.wanted(f'{kind}.{name}', rows[name], env)
            if base == 'std_msgs/Header':
                self.message('Header', value, core, given)
            elif base.startswith('hdlyap/'):
                self.list(f'{kind}.{name}', base[len('hdlyap/') :], value, wanted, core, given)
            else:
                self.field(kind, name, type_, value, rows[name], wanted)

    def wanted(self, name, row, env):
        try:
            return eval(row.code, env)
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

    def field(self, kind, name, type_, value, row, wanted):
        full, is_text = f'{kind}.{name}', type_.startswith('string')
        numbers = np.array([]) if is_text else as_numbers(value)
        known = np.isfinite(numbers) & (numbers != 0) & (numbers != -1)
        self.told |= {full} if (value if is_text else known.any()) else set()
        self.unknown |= {full} if np.any(np.isnan(numbers) | (numbers == -1)) else set()
        self.seen[kind, type_, name].update(repr(value).encode() + b'\n')
        if not (value == wanted if is_text else HOW[row.how](numbers, wanted)):
            self.differs(full, f'{value!r:.200}, but {row.text} is {wanted!r:.200}')

    def differs(self, name, how):
        self.wrong.setdefault(name, how)

    def holes(self):
        """Rows that would pass if they were wrong, as no scene fills the field, or none leaves it
        unknown where the row says how, or none tells it from another field of its message."""
        for kind, rows in self.tables.items():
            for name, row in rows.items():
                full = f'{kind}.{name}'
                if row.how == ':' or name == 'header':
                    continue
                if full not in self.told:
                    yield full
                if re.search(r'\bnan\b|else -1|-1 if', row.text) and full not in self.unknown:
                    yield full + '?'
        alike = collections.defaultdict(list)
        for (kind, type_, name), digest in self.seen.items():
            alike[kind, type_, digest.digest()].append(name)
        for (kind, *_), names in alike.items():
            if len(names) > 1:
                yield f'{kind}.{"=".join(names)}'


# ---- scenes

EVERY = 'spectrum modes steps lp_phases t_phases fields hydro structure covariant localization '
EVERY = (EVERY + 'fluctuations gas state').split()
REST = [name for name in EVERY if name != 'covariant']
TURNING = [name for name in REST if name != 'hydro']
WAVELESS = ['spectrum', 'localization', 'fluctuations']
# of few particles, most in boxes so long that steps are found at once
SHORT = dict(scene='a', equilibration=2.0, warmup=20.0, duration=40.0, report_interval=15.0)
SHORT.update(threads=1, observables=REST, slow_vectors_rate=4.0)
DISKS = dict(SHORT, scene='b', number=80, aspect=0.045, seed='2', max_wave_number=0.45)
DISKS.update(warmup=60.0, duration=250.0, report_interval=50.0, field_interval=100.0)
DISKS.update(target='lambda_max 0.001', changes=['80 report_interval=60', '90 field_interval=150'])
DISKS.update(phase_interval=1.0, fluctuation_time=1.5, accuracy=1e-7)
WALLS = dict(SHORT, number=40, aspect=14.0, boundary_x='reflecting', duration=900.0)
WALLS.update(report_interval=300.0, fluctuation_time=5.0, phase_interval=5.0)
SMALL = dict(SHORT, number=16, density=0.7, aspect=0.866, exponents='all_independent', interval=0.4)
SMALL.update(covariant_window=2.0, covariant_transient=10.0, covariant_sampling=0.5, pace=40.0)
SMALL.update(observables=EVERY, max_mode_number=1, covariant_memory=0.5, slow_vectors_count=9)
SMALL.update(slow_vectors_rate=20.0, covariant_storage='recompute')
CIRCLE = dict(SHORT, container='circle', number=60, density=0.7)
CIRCLE.update(observables=[name for name in REST if name not in ('t_phases', 'hydro', 'structure')])
SPHERES = dict(SHORT, particles='spheres', number=48, density=0.5, aspect_z=6.0, aspect=1.0)
SPHERES.update(max_mode_number=1, observables=EVERY, duration=100.0, report_interval=40.0)
SPHERES.update(covariant_window=40.0, covariant_transient=20.0, covariant_sampling=20.0)
DUMBBELLS = dict(SHORT, particles='dumbbells', number=36, density=0.5, aspect=0.1, bond=0.4)
DUMBBELLS.update(exponents='all', max_mode_number=1, observables=TURNING)
SOFT = dict(SHORT, particles='soft_disks', potential='power', number=36, density=0.2, aspect=0.05)
SOFT.update(max_mode_number=1, observables=TURNING, field_indices=[1, 66, 69])
BALLS = dict(SHORT, particles='soft_spheres', number=16, density=0.4, aspect=1.0, exponents=5)
BALLS.update(observables=['spectrum', 'gas', 'state'], duration=300.0, report_interval=100.0)
CHAIN = dict(SHORT, particles='chain', number=8, duration=6000.0, beta=2.0, observables=WAVELESS)
CHAIN.update(report_interval=2000.0, fluctuation_time=40.0)
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
    own = dict(program='chain_node')
    return [
        ('disks', DISKS, {}),
        ('walls', WALLS, {}),
        ('small', SMALL, dict(rare=True)),
        ('circle', CIRCLE, {}),
        ('spheres', SPHERES, {}),
        ('dumbbells', DUMBBELLS, {}),
        ('soft_disks', SOFT, {}),
        ('soft_spheres', BALLS, {}),
        ('chain', chain, own),
        ('resumed', resumed, dict(own, before=CHAIN)),
        ('few', FEW, {}),
    ]


class Published(harness.Case):
    def setUp(self):
        self.compared, self.folder = Compared(), self.new_folder()

    def run_of(self, name, params, program=None, rare=False):
        """{topic: messages} of a run, what the core said with them, and what the node logged."""
        path = os.path.join(self.folder, name)
        env = {'WITNESS': path, 'LD_PRELOAD': harness.program('hdlyap_witness.so')}
        env.update({'WITNESS_RARE': '1'} if rare else {})
        names = [*params['wait_for_subscribers'], 'slow_vectors']
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
        asked = Said(harness.defaults(), **{**dict(before), **params})
        warnings = [re.split(r'\]: |\x1b', line)[-2] for line in node.lines('which steps need')]
        run_id = messages['run_info'][-1].run_id
        messages = {  # without those that a node before it has latched
            topic: [one for one in those if one.run_id == run_id]
            for topic, those in messages.items()
        }
        names = dict(run_id=run_id, warning=''.join(warnings[:1]))
        for topic, those in messages.items():
            for message, core in self.beside(topic, those, said):
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
        for name, params, how in scenes(self.folder):
            with self.subTest(scene=name):
                self.compared.wrong.clear()
                self.scene(name, params, **how)
                wrong = [f'{name}: {how}' for name, how in self.compared.wrong.items()]
                self.assertEqual(wrong, [], name)
        self.assertEqual(set(self.compared.holes()), set(self.compared.untold))


def given_at(asked, params, core):
    """Parameters as they are when the core says this, and the changes that are made by then."""
    changes = [re.fullmatch(r'(\S+) (\w+)=(.*)', text).groups() for text in asked.changes]
    made = [
        Said(time=float(time), name=name, before=f'{asked[name]:g}', value=value)
        for time, name, value in changes
        if float(time) <= core.get('change_time', core.time)
    ]
    given = Said(asked, **{**core.get('effect', {}), **params})
    given.update((change.name, float(change.value)) for change in made)
    return dict(asked=asked, given=given, made=made)


if __name__ == '__main__':
    harness.main('published')
