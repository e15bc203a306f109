"""View -> what has not been said of a run: its system, and its steps in the table that plot prints,
as often as the node's log has them."""

import time
from math import inf

from hdlyap.data import fits, steps
from hdlyap.numbers import with_error
from hdlyap.plots import step_table
from hdlyap.plots.report import system

PERIOD = 3.0  # least seconds between two tables
NOT_HEARD = 'steps: computed only while somebody listens; --steps: listen'


class News:
    def __init__(self):
        self._run_id = None

    def of(self, view, ended=False):
        """Yields the lines. ended: also steps that are known better than in the last table."""
        if view.info is not None and view.info.run_id != self._run_id:
            self._run_id, self._is_heard = view.info.run_id, True
            self._time, self._averaged, self._known = -inf, 0.0, 0
            yield from _head(view)
        if self._run_id and self._has_more(view.steps, ended):
            yield from _table(view)
        if self._run_id and self._is_heard and _is_unheard(view):
            self._is_heard = False
            yield NOT_HEARD

    def _has_more(self, message, ended):
        """Whether the averaged time has doubled or more steps or errors are known, but not long
        after the last table."""
        if message is None or message.averaged_time == self._averaged:
            return False
        if message.averaged_time < self._averaged:
            self._averaged, self._known = 0.0, 0  # the averages were reset
        known = sum(1 + (step.std_error > 0) for step in _in_table(message) if step.resolved)
        is_more = ended or message.averaged_time >= 2 * self._averaged or known > self._known
        if not (known and is_more and (ended or time.monotonic() >= self._time + PERIOD)):
            return False
        self._time, self._averaged, self._known = time.monotonic(), message.averaged_time, known
        return True


def _in_table(message):
    return [step for step in message.steps if step.kind != steps.ZERO and not step.conjugate]


def _is_unheard(view):
    return 'steps' in view.info.observables and 'steps' not in view.others and not view.wanted


def _head(view):
    info = view.info
    yield f'{view.node}  {info.scene}  seed {info.seed}  run {info.run_id}'
    yield system(info)


def _table(view):
    if view.is_averaged and len(view.spectrum.exponents) > 1:
        total = with_error(view.spectrum.ks_entropy, view.sum_error)
        pairing = view.spectrum.pairing_error
        with_pairs = f', pairing error {pairing:.1e}' if pairing >= 0 else ''
        yield f'averaged {view.spectrum.averaged_time:.6g}, {view.sum_name} {total}{with_pairs}'
    yield from step_table.table(view).splitlines()
    for fit in fits.of(view.steps):
        if fit.count:
            yield f'  {fit.symbol:<4} {fit.measured} ({fit.basis})'
