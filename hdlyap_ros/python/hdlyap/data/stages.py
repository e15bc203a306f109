"""Names of stages, of limits of the interval, and of the parts of the cost."""

from hdlyap.data.fields import words
from hdlyap.msg import Cost, RunStatus

# name of a field of Cost without _seconds: what these seconds are for
LABELS = {
    'events': 'events',
    'replay': 'tangent replay',
    'ortho': 'orthonormalisation',
    'spectrum': 'averages',
    'modes': 'classification',
    'covariant': 'covariant vectors',
    'publish': 'publishing',
    'waiting': 'waiting for subscribers',
    'other': 'other',
}
PARTS = tuple(LABELS)[:-1]
STAGES = words(RunStatus, 'stage')
LIMITS = words(Cost, 'interval_limit')  # why the interval is not longer


def seconds(cost):
    """{part: wall seconds so far}; `other` is the rest of the wall time."""
    spent = {part: getattr(cost, part + '_seconds') for part in PARTS}
    return {**spent, 'other': max(0.0, cost.wall_seconds - sum(spent.values()))}
