"""What is said about the cost of a run: names for the constants and the seconds of hdlyap/Cost."""

from hdlyap.msg import Cost

# a field of that name, with _seconds behind it: what it is for
LABELS = {
    'events': 'events',
    'replay': 'tangent replay',
    'ortho': 'orthonormalisation',
    'spectrum': 'averages',
    'modes': 'classification',
    'covariant': 'covariant vectors',
    'publish': 'publishing',
    'other': 'other',
}
STAGES = tuple(LABELS)[:-1]
PHASES = {
    Cost.EQUILIBRATING: 'equilibrating',
    Cost.WARMING_UP: 'warming up',
    Cost.AVERAGING: 'averaging',
    Cost.FINISHED: 'finished',
}
# why the interval is not longer
LIMITS = {
    Cost.LIMIT_SCHEDULE: 'report interval',
    Cost.LIMIT_CONDITION: 'conditioning',
    Cost.LIMIT_GROWTH: 'doubling',
    Cost.LIMIT_OVERFLOW: 'overflow',
    Cost.LIMIT_SCENE: 'parameter interval',
    Cost.LIMIT_EVENTS: 'memory of the events',
    Cost.LIMIT_LOOK: 'vectors wanted',
    Cost.LIMIT_REPAIR: 'repair',
}


def seconds(cost):
    """{stage: wall seconds so far}; other is what no stage accounts for."""
    spent = {stage: getattr(cost, stage + '_seconds') for stage in STAGES}
    return {**spent, 'other': max(0.0, cost.wall_seconds - sum(spent.values()))}
