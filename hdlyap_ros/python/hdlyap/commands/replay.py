"""A bag played: by the wall time of its recording, or by the simulated time of its run.

Publishes the messages as they were recorded; latched topics are latched again. With --look it waits
at most half a minute until rviz, and with it the viewer, listens to pictures.
Service: ~pause_playback (std_srvs/SetBool)."""

import heapq
import math
import sys
import threading
import time
import warnings

import rosgraph
import rospy
from std_srvs.srv import SetBool, SetBoolResponse

from hdlyap.data import reader
from hdlyap.numbers import positive

PATIENCE = 30.0  # seconds to wait until somebody listens to pictures
DRAWN = 'state', 'fields', 'spectrum', 'steps', 'lp_phases', 'status'  # what a viewer listens to
CONNECTING = 3.0  # seconds to wait for subscribers, some of which may be gone
DISORDER = 1.0  # most seconds by which a recorder puts messages of different topics out of order


def options(parser):
    parser.add_argument('bag', help='file recorded by record.launch or rosbag')
    speed = parser.add_mutually_exclusive_group()
    text = 'how much faster than it was recorded (default: 1)'
    speed.add_argument('--rate', type=positive, default=1.0, metavar='FACTOR', help=text)
    text = 'simulated time units per second of wall time, instead of --rate'
    speed.add_argument('--pace', type=positive, metavar='TIME', help=text)
    parser.add_argument(
        '--begin', type=float, default=-math.inf, metavar='TIME', help='simulated time to begin at'
    )
    parser.add_argument('--loop', action='store_true', help='begin again at the end')
    parser.add_argument(
        '--pause', action='store_true', help='wait for rosservice call ~pause_playback false'
    )
    parser.add_argument(
        '--wait', action='store_true', help='wait until every topic has a subscriber'
    )
    parser.add_argument(
        '--look', metavar='NODE', help='wait until rviz shows the pictures of this node'
    )
    parser.add_argument('--keep-alive', action='store_true', help='stay after the end')


def raw_class(connection):
    """The class of a topic's messages as they are in the bag. A publisher asks it for their
    type."""
    about = {'_type': connection.datatype, '_md5sum': connection.md5sum}
    about.update(_full_text=connection.msg_def, _has_header=False)  # rospy would renumber headers
    return type('Raw', (rospy.AnyMsg,), about)


class Message:
    """A message as it is in the bag. Messages of other packages get run and simulated time of the
    message before."""

    def __init__(self, topic, kind, data, stamp, before):
        self.topic, self.data, self.wall = topic, data, stamp.to_sec()
        self.is_info = kind == reader.RUN_INFO
        self.run, self.time = (before.run, before.time) if before else (None, -1.0)
        if kind.startswith('hdlyap/'):
            packed = reader.Packed(topic, kind, data, stamp)
            self.run, self.time = packed.run_id, -1.0 if self.is_info else packed.sim_time


def as_recorded(bag):
    message = None
    for topic, (kind, data, *_), stamp in reader.recorded(bag):
        message = Message(topic, kind, data, stamp, message)
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


class Clock:
    """Says when a message is due. The first one of a run is due at once."""

    def __init__(self, args, running):
        self._rate, self._by_run = args.pace or args.rate, args.pace is not None
        self._running = running  # an event that is set while the playback is not paused
        self._run = self._last = self._due = None

    def wait_for(self, message):
        """Sleeps until the message is due."""
        now = message.time if self._by_run else message.wall
        if self._due is None or (self._by_run and message.run != self._run):
            self._due, self._last, self._run = time.monotonic(), now, message.run
        if now > self._last:
            self._due += (now - self._last) / self._rate
        set_back = not self._by_run and now < self._last - DISORDER  # covariant vectors come late
        if now > self._last or set_back:
            self._last = now
        self._hold()
        while time.monotonic() < self._due and not rospy.is_shutdown():
            time.sleep(min(0.1, max(0.0, self._due - time.monotonic())))
            self._hold()

    def _hold(self):
        """Waits while paused. All later messages are due later by that time."""
        if self._running.is_set():
            return
        began = time.monotonic()
        while not self._running.wait(0.1) and not rospy.is_shutdown():
            pass
        self._due += time.monotonic() - began


class Player:
    def __init__(self, bag, args):
        self._bag, self._args = bag, args
        self._running = threading.Event()
        self._pause(args.pause)
        self._publishers = {}
        warnings.filterwarnings('ignore', message='.*queue_size')
        connections = list(bag._get_connections())
        reader.refuse_others(bag, connections)
        for connection in connections:
            for what, name in (('topic', connection.topic), ('type', connection.datatype)):
                if not rosgraph.names.is_legal_name(name):
                    raise reader.RecordingError(
                        '%s: damaged: %s %s is no legal ROS name' % (args.bag, what, name)
                    )
            if connection.topic not in self._publishers:
                latching = connection.header.get('latching')  # rosbag filter drops it
                latch = connection.datatype == reader.RUN_INFO or latching in (b'1', '1')
                # with queue_size=None publishing waits for slow subscribers; rospy warns of that
                how = {'queue_size': None, 'latch': latch}
                of_topic = rospy.Publisher(connection.topic, raw_class(connection), **how)
                self._publishers[connection.topic] = of_topic
        rospy.Service('~pause_playback', SetBool, lambda request: self._pause(request.data))

    def _pause(self, yes):
        (self._running.clear if yes else self._running.set)()
        return SetBoolResponse(True, 'paused' if yes else 'goes on')

    def play(self):
        """Plays the bag, once all nodes are connected that have subscribed already."""
        if self._args.wait:
            self._wait_until(lambda: all(map(is_heard, self._publishers.values())))
        end = time.monotonic() + CONNECTING
        subscribers = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1])
        wanted = {
            publisher: len(subscribers.get(publisher.resolved_name, ()))
            for publisher in self._publishers.values()
        }
        self._wait_until(
            lambda: time.monotonic() > end
            or all(one.get_num_connections() >= count for one, count in wanted.items())
        )
        while not rospy.is_shutdown():
            self._play_once()
            if not self._args.loop:
                break

    def _play_once(self):
        """Plays the bag once. run_info is published at once, all else after waiting for --look."""
        clock = Clock(self._args, self._running)
        looked, played, message = not self._args.look, False, None
        for message in (as_simulated if self._args.pace else as_recorded)(self._bag):
            if not message.is_info:
                if message.time < self._args.begin:
                    continue
                if not looked:
                    self._wait_for_looks()
                    looked = True
                clock.wait_for(message)
                played = True
            if rospy.is_shutdown():
                return
            self._publish(message)
        if not played:
            nothing = (
                'no messages from t = %g on' % self._args.begin if message else 'the bag is empty'
            )
            raise reader.RecordingError('%s: %s' % (self._args.bag, nothing))
        print('hdlyap replay: at the end, t = %g' % message.time)

    def _publish(self, message):
        publisher = self._publishers[message.topic]
        raw = publisher.data_class()
        raw._buff = message.data
        publisher.publish(raw)

    def _wait_for_looks(self):
        node = '/' + self._args.look.strip('/')
        drawn = [p for t, p in self._publishers.items() if t in {node + '/' + d for d in DRAWN}]
        if not drawn or node + '/run_info' not in self._publishers:
            print('hdlyap replay: nothing of %s in this bag can be drawn' % node)
            return
        end = time.monotonic() + PATIENCE
        self._wait_until(
            lambda: time.monotonic() > end
            or (is_looked_at(node + '/markers') and all(map(is_heard, drawn)))
        )
        if time.monotonic() > end:
            print(
                'hdlyap replay: nobody subscribes to %s/markers yet; begins without subscriber'
                % node,
                flush=True,
            )

    @staticmethod
    def _wait_until(condition):
        while not condition() and not rospy.is_shutdown():
            time.sleep(0.1)


def is_heard(publisher):
    return publisher.get_num_connections() > 0


def is_looked_at(topic):
    """Whether a node listens to pictures, other than hdlyap view, which only waits for the first
    one."""
    subscribers = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1])
    return any(not name.startswith('/view_') for name in subscribers.get(topic, ()))


def main(args):
    sys.stdout.reconfigure(line_buffering=True)
    with reader.opened(args.bag) as bag:
        try:
            rospy.init_node('replay')
        except rospy.ROSInitException:  # interrupted while there was no master
            return 130
        try:
            Player(bag, args).play()
        except (rospy.ROSInterruptException, rosgraph.MasterException, OSError):
            if not rospy.is_shutdown():
                raise
    if args.keep_alive:
        rospy.spin()
    return 0
