"""Recording, replaying and repeating runs by the launch files: nothing is lost, nothing is changed,
and a bag says all of its run."""

import glob
import math
import os
import signal
import tempfile
import time
import xmlrpc.client

import numpy as np
import rosbag
import rosgraph
import rospy
import xarray
from std_srvs.srv import SetBool

import harness
import hdlyap
from hdlyap.data import fields
from hdlyap.plots import report
import links
from harness import MODES, NODE, OBSERVABLES, SHORT, TYPES, Process

pytestmark = harness.UNDER_A_MASTER

# a second run in the bag, and before it a first one
FIRST = dict(SHORT, seed='7', observables=OBSERVABLES, wait_for_subscribers='all')
RUN = dict(
    MODES,
    seed='11',
    threads=1,
    pace=100.0,
    observables=OBSERVABLES,
    field_interval=5.0,
    wait_for_subscribers='all',
)
REPORTS, BEGIN = 90, 70.0  # of RUN; where its averaging begins
# 64 kB a report
BULKY = dict(
    number=2000,
    density=0.7,
    aspect=1.0,
    exponents=1,
    equilibration=0.2,
    warmup=0.2,
    duration=0.0,
    report_interval=0.1,
    pace=20.0,
    observables=['spectrum', 'state'],
    wait_for_subscribers='all',
)
# of topics that the probe knows by another name
PROBED = dict(fields='mode_field', status='run_status')


def of_z(messages):
    """(name, value) of all fields of these, and of what they list."""
    for message in messages:
        for name in message.__slots__:
            value = getattr(message, name)
            if name.endswith('z'):
                yield name, tuple(value) if isinstance(value, list) else value
            elif isinstance(value, list) and hasattr(next(iter(value), None), '__slots__'):
                yield from of_z(value)


def launch(folder, *args):
    return Process(['roslaunch', 'hdlyap', *args], PWD=folder)


def end(process):
    """Ctrl-C; killed, roslaunch would leave others behind."""
    if process.running():
        process.send(signal.SIGINT)
    assert process.wait() == 0, process.text()


def seconds_of(process):
    """Of processors that it has taken so far."""
    with open(f'/proc/{process.process.pid}/stat') as file:
        fields = file.read().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def is_recorded(node, topics):
    """True once the recorder is connected to all of these topics of a node that goes on."""
    with xmlrpc.client.ServerProxy(links.node_uri(node)) as proxy:
        connected = {
            topic for _, to, _, _, topic, *_ in proxy.getBusInfo('/test')[2] if to == '/record'
        }
    return {rosgraph.names.resolve_name(topic, '/%s/x' % NODE) for topic in topics} <= connected


class Raw:
    """Bytes of all messages of some topics, in the order of their arrival."""

    def __init__(self, topics):
        self.messages = {topic: [] for topic in topics}
        self.subscribers = [
            rospy.Subscriber(topic, rospy.AnyMsg, self.keep, topic, queue_size=None)
            for topic in topics
        ]

    def keep(self, message, topic):
        self.messages[topic].append(message._buff)

    def close(self):
        for subscriber in self.subscribers:
            subscriber.unregister()


def read(path):
    """By topic, messages as (type name, bytes, md5 sum, class)."""
    messages = {}
    with rosbag.Bag(path) as bag:
        for topic, (kind, data, md5, *_, cls), _ in bag.read_messages(raw=True):
            messages.setdefault(topic, []).append((kind, bytes(data), md5, cls))
    return messages


def unpacked(packed):
    return [cls().deserialize(data) for _, data, _, cls in packed]


class Recorded(harness.Case):
    """Two runs of one node in one bag."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder, cls.bag = folder.name, os.path.join(folder.name, 'run.bag')
        rospy.set_param('/use_sim_time', True)  # left over: nobody has a clock
        recorder = launch(cls.folder, 'record.launch', 'bag:=run')
        cls.addClassCleanup(end, recorder)
        cls.counts = [cls.run_of(params) for params in (FIRST, RUN)]
        rospy.delete_param('/use_sim_time')
        end(recorder)
        cls.said = recorder.text()
        cls.messages = read(cls.bag)
        # a latched one comes twice to whom connects while it is published, by roscpp
        packed = cls.messages['/hdlyap/run_info']
        infos = [TYPES['run_info']().deserialize(data) for _, data, *_ in packed]
        cls.infos = list({info.run_id: info for info in infos}.values())

    @classmethod
    def run_of(cls, params):
        """Messages published, by topic."""
        counts = os.path.join(cls.folder, 'counts')
        node = harness.start(params, probe={'PROBE_COUNTS': counts})
        cls.addClassCleanup(node.stop)
        assert node.wait() == 0, node.text()  # it has waited for the recorder
        with open(counts) as file:
            made = {name: int(count) for name, count in map(str.split, file)}
        return {topic: made[PROBED.get(topic, topic) + '_publish'] for topic in TYPES}

    def of_run(self, topic, number):
        messages = unpacked(self.messages.get('/hdlyap/' + topic, []))
        return [message for message in messages if message.run_id == self.infos[number].run_id]

    def test_nothing_is_lost(self):
        for number, counts in enumerate(self.counts):
            for topic, count in counts.items():
                with self.subTest(run=number, topic=topic):
                    seqs = [message.header.seq for message in self.of_run(topic, number)]
                    seqs = sorted(set(seqs)) if topic == 'run_info' else seqs
                    self.assertEqual(len(seqs), count)
                    self.assertEqual(seqs, list(range(seqs[0], seqs[0] + count)) if seqs else [])
        self.assertEqual([len(self.of_run('state', k)) for k in (0, 1)], [4, REPORTS])
        self.assertGreater(self.counts[1]['fields'], 0)
        self.assertEqual(len(self.messages['/hdlyap/state']), 4 + REPORTS)  # and of no other run
        self.assertEqual([info.seed for info in self.infos], ['7', '11'])
        ours = [of for topic, of in self.messages.items() if topic.startswith('/hdlyap/')]
        self.assertIn(f'the bag is {self.bag}: {sum(map(len, ours))} messages;', self.said)

    def test_first_report(self):
        """The runs have waited for the recorder."""
        for number in (0, 1):
            for topic in ('state', 'status', 'cost'):
                self.assertEqual(self.of_run(topic, number)[0].sim_time, 1.0)

    def test_fields_come_now_and_then(self):
        times = {message.sim_time - BEGIN for message in self.of_run('fields', 1)}
        resolved = {
            message.sim_time - BEGIN
            for message in self.of_run('steps', 1)
            if harness.examples(message.steps)
        }
        self.assertEqual(times, resolved & {1.0, 5.0, 10.0, 15.0, 20.0})
        self.assertIn(20.0, times)

    def test_as_a_dataset(self):
        """All topics; netCDF keeps it."""
        made, path = hdlyap.load(self.bag).to_xarray(), os.path.join(self.folder, 'run.nc')
        made.to_netcdf(path)
        self.assertTrue(xarray.load_dataset(path).identical(made))
        last = self.of_run('spectrum', 1)[-1]
        np.testing.assert_array_equal(made['exponents'].isel(time=-1), last.exponents)
        self.assertTrue(np.isfinite(made['exponents']).all())  # no time but its own
        self.assertTrue(np.isfinite(made['gas_pressure']).all())
        self.assertEqual(made['state_px'].shape, (REPORTS, MODES['number']))

    def test_types_and_definitions(self):
        with rosbag.Bag(self.bag) as bag:
            connections = [c for c in bag._get_connections() if c.topic.startswith('/hdlyap/')]
        self.assertEqual({c.topic.rsplit('/', 1)[1] for c in connections}, set(TYPES))
        for connection in connections:
            kind = TYPES[connection.topic.rsplit('/', 1)[1]]
            self.assertEqual((connection.datatype, connection.md5sum), (kind._type, kind._md5sum))
            self.assertEqual(connection.msg_def.strip(), kind._full_text.strip())
            latched = kind in (TYPES['run_info'], TYPES['status'])
            self.assertEqual(connection.header.get('latching', b'0'), b'1' if latched else b'0')

    def test_lengths(self):
        """Arrays by vector and by particle have an element for each that the run has."""
        found = set()
        for number, info in enumerate(self.infos):
            wanted = {('vector',): info.vectors, ('particle',): info.number}
            for topic, kind in TYPES.items():
                shaped = fields.of(kind)
                for message in self.of_run(topic, number):
                    for name, field in shaped.items():
                        length = len(getattr(message, name)) if field.shape in wanted else 0
                        if length or (field.shape in wanted and not field.only):
                            self.assertEqual(length, wanted[field.shape], (topic, name))
                            found.add((topic, field.shape[0]))
        by_vector = {topic for topic, of in found if of == 'vector'}
        self.assertLessEqual({'spectrum', 'modes', 'localization', 'fluctuations'}, by_vector)
        self.assertLessEqual({('state', 'particle'), ('fields', 'particle')}, found)

    def test_disks_have_no_z(self):
        """Arrays of z are empty, texts too, numbers 0 or not known: but in what draws the waves."""
        names = set()
        for topic in TYPES:
            for name, value in of_z(self.of_run(topic, 1)):
                names.add(name)
                if name == 'pressure_z':
                    self.assertTrue(math.isnan(value))
                elif name != 'wave_nz':
                    self.assertIn(value, (0, '', ()), (topic, name))
        self.assertLessEqual({'z', 'dpz', 'p_over_pz', 'nz', 'null_z', 'box_z'}, names)
        self.assertEqual((self.infos[1].boundary_z, set(self.infos[1].wave_nz)), ('', {0}))

    def test_disks_do_not_turn(self):
        """They have no angles; numbers of these are 0."""
        state, field = self.of_run('state', 1)[-1], self.of_run('fields', 1)[-1]
        arrays = [state.angle, state.spin, field.angle, field.spin, field.dq_angle, field.dp_angle]
        self.assertEqual(set(map(len, arrays)), {0})
        self.assertEqual({mode.rotation for mode in self.of_run('modes', 1)[-1].modes}, {0.0})
        info = self.infos[1]
        self.assertEqual(info.inertia, 0.0)
        self.assertAlmostEqual(info.packing_fraction, info.density * math.pi / 4, places=14)

    @harness.SECOND_TIER
    def test_replay(self):
        """Waits for those who listen, then tells them what the bag holds, byte for byte; and
        run_info to who comes late."""
        raw = Raw(self.messages)
        self.addCleanup(raw.close)
        args = 'bag:=run.bag pace:=20 paused:=true keep_alive:=true wait_for_subscribers:=true'
        replay = launch(self.folder, 'replay.launch', *args.split())
        self.addCleanup(end, replay)
        rospy.wait_for_service('/replay/pause_playback', harness.PATIENCE)
        pause = rospy.ServiceProxy('/replay/pause_playback', SetBool)
        told = {topic for topic, messages in raw.messages.items() if messages}
        self.assertLessEqual(told, {'/hdlyap/run_info'})
        self.sees(lambda: pause(False) and any(raw.messages.values()))
        want = {
            topic: [data for _, data, _, _ in messages] for topic, messages in self.messages.items()
        }
        harness.wait_until(lambda: raw.messages == want)
        for topic in want:
            self.assertEqual(raw.messages[topic], want[topic], topic)
        rospy.sleep(0.5)  # by now a replay that does not stay has gone
        late = Raw(['/hdlyap/run_info'])
        self.addCleanup(late.close)
        self.sees(lambda: late.messages['/hdlyap/run_info'])
        self.assertEqual(late.messages['/hdlyap/run_info'], want['/hdlyap/run_info'][-1:])
        end(replay)

    @harness.SECOND_TIER
    def test_repeat(self):
        """From the bag alone: every number of every topic, bit for bit."""
        repeat = Process([*harness.command('repeat'), self.bag, '--run', '2'])
        self.ends(repeat)
        with open(os.path.join(self.folder, 'again.yaml'), 'w') as file:
            file.write(repeat.text())
        again = launch(
            self.folder, 'run.launch', 'scene:=again.yaml', 'record:=true', 'bag:=again.bag'
        )
        self.addCleanup(end, again)
        self.ends(again)
        repeated = read(os.path.join(self.folder, 'again.bag'))
        for topic in OBSERVABLES:
            with self.subTest(topic=topic):
                got = unpacked(repeated['/hdlyap/' + topic])
                self.assert_same_bits(got, self.of_run(topic, 1))
        compare = Process(
            [*harness.command('compare'), self.bag, os.path.join(self.folder, 'again.bag')]
        )
        self.ends(compare)
        self.assertIn('identical', compare.text())


@harness.SECOND_TIER
class Stopped(harness.Case):
    def setUp(self):
        self.folder = self.new_folder()

    def record(self, *args):
        recorder = launch(self.folder, 'record.launch', *args)
        self.addCleanup(end, recorder)
        return recorder

    def files(self, pattern):
        return sorted(glob.glob(os.path.join(self.folder, pattern)))

    def test_in_the_middle(self):
        """A recorder that is asked to end has closed its files; one that comes late is told
        run_info; when its node is killed, its bag can still be read."""
        first = self.record('bag:=first.bag', 'options:=--lz4 --split --repeat-latched --size=1')
        node = self.start(BULKY)
        self.sees(lambda: len(self.files('first_*')) > 2)
        end(first)
        self.assertTrue(node.running())
        self.start(dict(node='/hdlyap'), name='viewer', command=[harness.program('viewer')])
        second = self.record('bag:=second.bag')
        averaged = self.listen('spectrum')
        self.sees(lambda: is_recorded(node, ['run_info', 'spectrum', 'state', 'cost']))
        begin = len(averaged.messages)
        self.sees(lambda: len(averaged.messages) > begin + 5)
        node.stop()
        end(second)
        self.check_parts(self.files('first_*'))
        self.check_read(self.files('second*'))

    def test_recorder_rests(self):
        """The recorder waits for rosbag, without a thread that works all the time."""
        path = os.path.join(self.folder, 'rests.bag')
        recorder = self.process([harness.program('record'), '_bag:=' + path])
        node = self.start(dict(SHORT, duration=0.0, pace=5.0))
        self.sees(lambda: is_recorded(node, ['spectrum', 'state']))
        begin = seconds_of(recorder)
        time.sleep(3.0)
        self.assertLess(seconds_of(recorder) - begin, 0.3)
        node.stop()
        recorder.send(signal.SIGINT)
        self.assertEqual(recorder.wait(), 0, recorder.text())

    def check_parts(self, paths):
        """Files of one recording: run_info in each, the rest in one of them, nothing left out."""
        self.assertEqual(self.files('*.active'), [])
        self.assertGreater(len(paths), 2)
        parts = [read(path) for path in paths]
        ids = {message.run_id for part in parts for message in unpacked(part['/hdlyap/run_info'])}
        self.assertEqual(len(ids), 1)
        self.assertFalse(any('/hdlyap/markers' in part for part in parts))
        states = [message for part in parts for message in unpacked(part.get('/hdlyap/state', []))]
        self.assertEqual({message.run_id for message in states}, ids)
        self.assertEqual(states[0].sim_time, BULKY['report_interval'])
        seqs = [message.header.seq for message in states]
        self.assertEqual(seqs, list(range(seqs[0], seqs[0] + len(seqs))))

    def check_read(self, paths):
        self.assertEqual([os.path.basename(path) for path in paths], ['second.bag'])
        messages = read(paths[0])
        self.assertEqual(len(messages['/hdlyap/run_info']), 1)
        self.assertFalse({'/hdlyap/markers', '/hdlyap/slow_vectors'} & set(messages))
        self.assertIn('lambda_max', report.report(hdlyap.load(paths[0]).summary))
