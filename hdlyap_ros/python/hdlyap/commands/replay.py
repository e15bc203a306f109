"""A bag played by the simulated time of its run.

Writes a bag whose stamps are simulated time, a time unit a second, run after run, and lets rosbag
play publish it. Without --out this bag is in TMPDIR, which needs room for it. rosbag play BAG
itself plays by the wall time of the recording.
Service: ~pause_playback (std_srvs/SetBool)."""

import heapq
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
from types import SimpleNamespace

import roslib.packages
import rosbag
import rosgraph
import rospy

from hdlyap import signals, whole
from hdlyap.data import reader
from hdlyap.numbers import positive

DISORDER = 1.0  # most seconds by which a recorder puts messages of different topics out of order
START = 10**9  # first stamp [ns]
LATEST = 1e9  # most simulated time; stamps end at 2^32 s
POLL = 0.1  # seconds between two looks whether it still plays
# options of rosbag play: those of the user's, and ours, by which no message is lost at the start or
# to a slow subscriber
OPTIONS = {
    'loop': 'begin again at the end',
    'pause': 'wait for rosservice call ~pause_playback false',
    'wait-for-subscribers': 'wait until every topic has a subscriber',
    'keep-alive': 'stay after the end',
}
OURS = '--delay=1', '--queue=0'


def options(parser):
    parser.add_argument('bag', help='file recorded by record.launch or rosbag')
    text = 'simulated time units per second of wall time (default: 1)'
    parser.add_argument('--pace', type=positive, default=1.0, metavar='TIME', help=text)
    text = 'simulated time to begin at'
    parser.add_argument('--begin', type=float, default=-math.inf, metavar='TIME', help=text)
    text = 'wall seconds between run_info and all else, in which rviz opens'
    parser.add_argument('--lead', type=float, default=0.0, metavar='SECONDS', help=text)
    text = 'only write the bag, with another name, for rosbag play'
    parser.add_argument('--out', metavar='FILE', help=text)
    for name, text in OPTIONS.items():
        parser.add_argument('--' + name, action='store_true', help=text)


class Message:
    """A message as it is in the bag. Messages of other packages get run and simulated time of the
    message before; run_info, and what comes before any time is known, the time -1."""

    def __init__(self, path, topic, raw, stamp, before):
        self.topic, self.raw, self.wall = topic, raw[:3], stamp.to_sec()
        self.run, self.time = (before.run, before.time) if before else (None, -1.0)
        if raw[0].startswith('hdlyap/'):
            packed = reader.Packed(topic, raw[0], raw[1], stamp)
            self.run, self.time = packed.run_id, -1.0
            if raw[0] != reader.RUN_INFO:
                self.time = _possible(f'{path}: {topic}', packed.sim_time)


def _possible(where, time):
    """The simulated time of a message. Raises RecordingError if no stamp can be made of it."""
    if not 0 <= time <= LATEST:
        raise reader.RecordingError(f'{where}: sim_time = {time:g}: must be from 0 to {LATEST:g}')
    return time


def as_recorded(bag):
    message = None
    for topic, raw, stamp in reader.recorded(bag):
        message = Message(bag.filename, topic, raw, stamp, message)
        yield message


def as_simulated(bag):
    """Yields messages run after run, each run in the order of simulated time."""
    waiting, runs = [], {}
    for count, message in enumerate(as_recorded(bag)):
        number = runs.setdefault(message.run, len(runs))
        heapq.heappush(waiting, (number, message.time, count, message))
        while message.wall - waiting[0][-1].wall > DISORDER:
            yield heapq.heappop(waiting)[-1]
    while waiting:
        yield heapq.heappop(waiting)[-1]


def stamped(bag, begin, lead):
    """Yields (message, stamp [ns]) from a simulated time on; lead: by how much
    messages with a time come after run_info. Stamps go up, so that messages keep their order."""
    now, run, origin, message = START, None, None, None
    for message in as_simulated(bag):
        at = now + 1
        if message.time >= 0:
            if message.time < begin:
                continue
            if origin is None or message.run != run:
                wait = lead if origin is None else 0.0
                run, origin = message.run, now * 1e-9 + wait - message.time
            at = max(at, round((origin + message.time) * 1e9))  # covariant vectors come late
        yield message, at
        now = at
    if origin is None:
        nothing = 'no messages from t = %g on' % begin if message else 'the bag is empty'
        raise reader.RecordingError('%s: %s' % (bag.filename, nothing))


def write(bag, path, begin, lead):
    """Writes the bag that is played."""
    headers = {connection.topic: header(bag, connection) for connection in connections(bag)}
    with rosbag.Bag(path, 'w', compression='lz4') as made:
        for message, at in stamped(bag, begin, lead):
            of_topic = headers[message.topic]
            about = SimpleNamespace(_md5sum=message.raw[2])  # instead of a class, which may lack
            raw, stamp = (*message.raw, about), rospy.Time(*divmod(at, 10**9))
            made.write(message.topic, raw, stamp, raw=True, connection_header=of_topic)


def connections(bag):
    found = list(bag._get_connections())
    reader.refuse_others(bag, found)
    for connection in found:
        for what, name in (('topic', connection.topic), ('type', connection.datatype)):
            if not rosgraph.names.is_legal_name(name):
                raise reader.RecordingError(
                    '%s: damaged: %s %s is no legal ROS name' % (bag.filename, what, name)
                )
    return found


def header(bag, connection):
    """What rosbag play has to know of a topic."""
    latching = connection.header.get('latching')  # rosbag filter drops it
    latch = connection.datatype == reader.RUN_INFO or latching in (b'1', '1')
    return {
        'topic': connection.topic,
        'type': connection.datatype,
        'md5sum': connection.md5sum,
        'message_definition': connection.msg_def,
        'latching': '1' if latch else '0',
    }


def chosen(args):
    """The options for rosbag play that the user has given."""
    return ['--' + name for name in OPTIONS if getattr(args, name.replace('-', '_'))]


def play(path, args):
    """Plays a bag until its end or a signal. Returns the exit status."""
    ours = [*OURS, f'--rate={args.pace}', *(() if sys.stdout.isatty() else ['--quiet'])]
    program = roslib.packages.find_node('rosbag', 'play')[0]
    command = [program, *ours, *chosen(args), path, *args.assigned]
    with signals.held() as came:
        process, told = subprocess.Popen(['setpriv', '--pdeathsig', 'INT', *command]), 0
        while process.poll() is None:
            if len(came) > told:
                told = len(came)
                process.send_signal(signal.SIGINT)
            time.sleep(POLL)
    return signals.of_shell(process.returncode)


def main(args):
    lead = args.lead * args.pace
    if args.out:
        of_play = ' '.join([*chosen(args), *args.assigned])
        if of_play:
            print(f'hdlyap replay: {of_play}: must not be given with --out', file=sys.stderr)
            return 2
        with reader.opened(args.bag) as bag, whole.written(args.out) as path:
            write(bag, path, args.begin, lead)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'replay.bag')
        with reader.opened(args.bag) as bag:
            write(bag, path, args.begin, lead)
        return play(path, args)
