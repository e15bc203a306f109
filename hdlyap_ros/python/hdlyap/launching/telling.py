"""A running hdlyap_node -> on the terminal: its steps as they improve, its result at the end."""

import threading
import time

import rosgraph
import rospy

from hdlyap.follow.watch import View, fill, lazy
from hdlyap.msg import RunInfo, RunStatus, Spectrum, Steps
from hdlyap.plots import fits, step_table, steps
from hdlyap.plots.numbers import clock, with_error

from . import bags

KINDS = {'spectrum': Spectrum, 'steps': Steps}
POLL = 0.1  # seconds
PERIOD = 3.0  # seconds between two tables, at least
LAST_WORDS = 2.0  # seconds that the last messages of a run that has ended may take


class Teller:
    """Listens and prints until the run has ended. The run may wait for a subscriber of status: then
    all the others are connected. `bag`: what is recorded, '' if nothing."""

    def __init__(self, node, bag=''):
        self._node, self._bag = node, bag
        self._last = {}
        self._averaged, self._found, self._told = 0.0, set(), 0.0

    def listen(self, ended):
        """Until connected, or until the event."""
        self._subscribe('run_info', RunInfo)
        self._wait(lambda: 'run_info' in self._last, ended)
        if 'run_info' not in self._last:
            return
        topics = set(self._last['run_info'].unpacked().observables) & set(KINDS)
        ears = [self._subscribe(topic, KINDS[topic]) for topic in sorted(topics)]
        self._wait(lambda: all(ear.get_num_connections() for ear in ears), ended)
        self._subscribe('status', RunStatus)

    def _subscribe(self, topic, kind):
        name = f'{self._node}/{topic}'
        return rospy.Subscriber(name, lazy(kind), self._hear, topic, queue_size=1)

    def _hear(self, message, topic):
        self._last[topic] = message

    @staticmethod
    def _wait(condition, ended):
        while not condition() and not ended.wait(POLL):
            continue

    def tell(self, ended):
        """Tables now and then, until the event."""
        while not ended.wait(POLL):
            if time.monotonic() < self._told + PERIOD:
                continue
            view = self._view()
            if view.is_averaged and not view.is_finished and self._is_news(view):
                self._print(self._head(view), view)

    def result(self):
        """Of a run that has ended, whose last messages may still be on their way."""
        until = time.monotonic() + LAST_WORDS
        while time.monotonic() < until and not self._is_complete(self._view()):
            time.sleep(POLL)
        view = self._view()
        if view.status is None:
            return
        what = f'no averages at simulated time {view.status.sim_time:g}'
        if view.is_averaged:
            what = averages(view)
        self._print(f'result of {self._node}, {view.info.scene}: {what}', view, self._where())

    def _where(self):
        if not self._bag or not bags.in_the_way(self._bag):
            return []
        return [f'  recorded in {self._bag}', f'  rosrun hdlyap plot_bag {self._bag}']

    def _view(self):
        view = View()
        fill(view, {topic: message.unpacked() for topic, message in dict(self._last).items()})
        return view

    @staticmethod
    def _is_complete(view):
        """With the averages of the last report."""
        if not view.is_finished:
            return False
        known = [part for part in (view.spectrum, view.steps) if part is not None]
        return all(part.sim_time == known[0].sim_time for part in known)

    def _is_news(self, view):
        """Twice the time has been averaged, or a step has been found or has got an error."""
        averaged, found = view.spectrum.averaged_time, known_steps(view)
        if averaged < self._averaged:  # it was reset
            self._averaged, self._found = 0.0, set()
        if averaged < 2 * self._averaged and found <= self._found:
            return False
        self._averaged, self._found = averaged, self._found | found
        return bool(found) or view.steps is None

    def _head(self, view):
        left = view.status.remaining_seconds if view.status else -1.0
        return f'{self._node}: {averages(view)}' + (f', {clock(left)} left' if left >= 0 else '')

    def _print(self, head, view, more=()):
        self._told = time.monotonic()
        print('\n'.join(['', head, *table(view), *more]), flush=True)


def averages(view):
    spectrum = view.spectrum
    whole = f' of {view.info.duration:g}' if view.info.duration > 0 else ''
    text = f'averaged {spectrum.averaged_time:.6g}{whole} time units'
    if len(spectrum.exponents):
        text += f', lambda_max {with_error(spectrum.lambda_max, spectrum.std_errors[0])}'
    return text


def known_steps(view):
    """Names of the steps that were found, once more where their errors are known."""
    found = steps.resolved(view.steps)
    return set(found) | {name + ' error' for name, step in found.items() if step.std_error > 0}


def table(view):
    message = view.steps
    rows = [cells for cells, _ in step_table.block_rows(message, {})] if message else []
    if not rows:
        return
    yield from step_table.layout(rows)
    for fit in fits.of(message):
        if fit.count:
            phases = f', {fit.count} of them' if fit.symbol == 'v' else ''
            yield f'  {fit.symbol:<4} {fit.measured}  {fit.basis}{phases}'
    missing = steps.unresolved(message)
    if missing:
        yield f'  {len(missing)} steps not resolved'


def start(node, bag, ended):
    """A thread that tells until the event, and then the result."""

    def run():
        rospy.init_node(
            node.rpartition('/')[2] + '_steps', argv=[], disable_signals=True, log_level=rospy.ERROR
        )
        teller = Teller(node, bag)
        teller.listen(ended)
        teller.tell(ended)
        teller.result()
        rospy.signal_shutdown('the run has ended')

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread


def name_of(command):
    """Of the node that this command starts in this namespace."""
    given = [word[len('__name:=') :] for word in command if word.startswith('__name:=')]
    name = given[0] if given else 'hdlyap'
    return rosgraph.names.ns_join(rosgraph.names.get_ros_namespace(), name)
