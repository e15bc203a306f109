"""Names for the constants of hdlyap/RunStatus and hdlyap/Cost, and for the seconds of the cost."""

from hdlyap.msg import Cost, RunStatus

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
PARTS = tuple(LABELS)[:-1]
STAGES = {
    RunStatus.EQUILIBRATING: 'equilibrating',
    RunStatus.WARMING_UP: 'warming up',
    RunStatus.AVERAGING: 'averaging',
    RunStatus.FINISHED: 'finished',
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
    Cost.LIMIT_STAGE: 'end of the stage',
    Cost.LIMIT_SAMPLE: 'samples for errors',
    Cost.LIMIT_NONE: 'none yet',
}


def seconds(cost):
    """{part: wall seconds so far}; other is what no part accounts for."""
    spent = {part: getattr(cost, part + '_seconds') for part in PARTS}
    return {**spent, 'other': max(0.0, cost.wall_seconds - sum(spent.values()))}
