"""View -> panels. A panel is a list of lines, a line a list of (text, style)."""

from math import atan2, hypot, inf, isfinite, pi

from hdlyap.data import fits, steps, waves
from hdlyap.data.phases import apart
from hdlyap.data.stages import LIMITS, STAGES, seconds
from hdlyap.fault import whose
from hdlyap.msg import LpPhase
from hdlyap.numbers import clock, with_error
from hdlyap.plots import paper, step_table
from hdlyap.plots.report import system

from .layout import MORE, flow

LEVELS = {0: ('OK', 'ok'), 1: ('WARN', 'warn'), 2: ('ERROR', 'error'), 3: ('STALE', 'warn')}
KIND_STYLES = {steps.T: 'T', steps.LP: 'LP'}
PART_BAR = 6  # columns
ROOMY = 30  # a screen with this many lines has room for details
STATES = {LpPhase.WEAK: 'too weak now', LpPhase.COARSE: 'turns too fast'}
PHASE_ROW = '  {:<9} {:<{width}} {:>6} {:>7}  {} {:<6}{:<14} {}'
FORMULA = 17  # least columns of a formula; those of spheres are longer
PHASE_HEAD = 'LP phases', 'A', 'index', '|(a,b)|', ' ', '/2 pi', 'omega', 'v'


def of(view, width, height, glyphs):
    """All panels, {panel: lines}."""
    return {
        'head': head(view, width),
        'progress': progress(view, width, glyphs),
        'numbers': numbers(view, width, height),
        'table': table(view, width),
        'phases': phases(view, glyphs),
        'cost': cost(view, width, glyphs),
        'diagnosis': diagnosis(view),
        'keys': keys(view),
    }


def nonsense(error):
    said = whose(error) or 'unexpected contents in a message of the node'
    return f'{said}: {type(error).__name__}: {error}'


def head(view, width):
    """The run and its system."""
    info = view.info
    if info is None:
        return [[(view.node, 'strong')]]
    names = [(f'{view.node}  {info.scene}', 'strong'), f'seed {info.seed}', f'run {info.run_id}']
    return [*flow(names, width, '  '), [(system(info), '')]]


def progress(view, width, glyphs):
    status = view.status
    if status is None:
        return [[(_stage(view), 'strong')]]
    text = _stage(view)
    right = f' {100 * status.progress:5.1f} %' if status.progress > 0 else ''
    if 0 <= status.remaining_seconds < inf and not view.is_finished:
        right += f'  {clock(status.remaining_seconds)} left'
    room = width - len(text) - len(right) - 2
    line = [(text, 'strong'), ('  ', '')]
    if right and room >= 10:
        line.append((glyphs.bar(status.progress, room, rest=True), 'T'))
    return [line + [(right, '')], *flow(_times(view), width)]


def _stage(view):
    """What the run is doing. Diagnostics say more than the stage: paused, waiting for
    subscribers."""
    if view.is_finished or view.diagnosis is None:
        return STAGES.get(view.status.stage, '?') if view.status else 'waiting for its first word'
    said = {pair.key: pair.value for pair in view.diagnosis.values}
    return said.get('stage', '?')


def _times(view):
    status, info = view.status, view.info
    yield f'simulated {status.sim_time:.1f}'
    if view.is_averaged:
        whole = f' of {info.duration:g}' if info and info.duration > 0 else ''
        yield f'averaged {view.spectrum.averaged_time:.1f}{whole}'
    if status.target:
        yield f'{status.target} to {_number(status.target_error)} of {status.target_wanted:.2g}'
    if view.cost is not None:
        yield f'wall time {clock(view.cost.wall_seconds)}'
    if view.speed is not None:
        yield f'{view.speed:.3g} time units/s'


def numbers(view, width, height):
    """Exponents and fits; with the wave numbers of fits if there is room."""
    return flow(_numbers(view), width) + flow(_fits(view, height >= ROOMY), width)


def _numbers(view):
    spectrum, message = view.spectrum, _averaged_steps(view)
    if view.is_averaged and len(spectrum.exponents):
        yield f'lambda_max {with_error(spectrum.lambda_max, spectrum.std_errors[0])}'
        if len(spectrum.exponents) > 1 and view.info:
            yield f'{view.sum_name} {with_error(spectrum.ks_entropy, view.sum_error)}'
        if spectrum.pairing_error >= 0:
            yield f'pairing error {spectrum.pairing_error:.1e}'
    if message is not None:
        looked_for = [step.resolved for step in message.steps if step.kind != steps.ZERO]
        yield f'steps resolved {sum(looked_for)} of {len(looked_for)}'


def _averaged_steps(view):
    """The steps once there are averages; None before."""
    return view.steps if view.steps is not None and view.steps.averaged_time > 0 else None


def _fits(view, with_waves):
    for fit in fits.of(_averaged_steps(view)):
        if fit.count:
            basis = f' ({fit.basis})' if with_waves else ''
            yield f'{fit.symbol} {with_error(*fit.values[0][1:])}{fit.beside}{basis}'


def table(view, width):
    """A heading and a row for each step, or why there are none."""
    message = _averaged_steps(view)
    if message is None:
        return _without(view, 'steps')
    fitted = {step.name: step.fitted for step in paper.steps(view.info)} if view.info else {}
    found = list(step_table.block_rows(message, fitted, view.info))
    if view.info and view.is_averaged and view.last_index > view.positive_end:
        found.insert(0, (step_table.zero_cells(view), None))
    if not found:
        return _note('steps', 'none resolved yet')
    first, *rest = _table_lines([row for row, _ in found], bool(fitted), width)
    return [[(first, 'faint')]] + [
        [(text, KIND_STYLES.get(kind, ''))] for text, (_, kind) in zip(rest, found)
    ]


def _table_lines(rows, beside_paper, width):
    """The lines of the table. Values of the paper are beside it if there is room. If it is too
    wide, a row of several steps has not all of their names, as each step has a row, too."""
    for beside in (True, False) if beside_paper else (False,):
        lines = list(step_table.layout(rows, beside))
        room = width - len(MORE.format(999)) - len(lines[0])
        if room >= 0:
            return lines
    longest = max(len(row[0]) for row in rows) + room
    names = [joined(row[0].split('+'), max(longest, 0)) for row in rows]
    return list(step_table.layout([[name, *row[1:]] for name, row in zip(names, rows)]))


def joined(names, room):
    """The names as T(1,0)+T(0,1), as many as there is room for, and how many are left."""
    for count in range(len(names), 0, -1):
        left = len(names) - count
        text = '+'.join([*names[:count], *([f'{left} more'] if left else [])])
        if len(text) <= room:
            return text
    return names[0]


def phases(view, glyphs):
    """A heading and a row for each LP phase: for every step the phase that was tracked longest,
    then for every step the next one."""
    if view.phases is None:
        return _without(view, 'lp_phases')
    found = ranked(view.phases.phases)
    if not found:
        return _note('LP phases', 'no LP step resolved yet')
    rows = [_phase_cells(phase, view.info, glyphs) for phase in found]
    width = max(FORMULA, *(len(row[1]) for row in rows))
    lines = [PHASE_ROW.format(*row, width=width) for row in (PHASE_HEAD, *rows)]
    return [[(lines[0], 'faint')]] + [[(line, 'LP')] for line in lines[1:]]


def ranked(found):
    """Sorts phases of resolved steps: in each round there is one phase of every step. Phases of a
    step that share neither vector nor pair come first."""
    by_step = {}
    for number, phase in enumerate(found):
        if phase.state != LpPhase.UNRESOLVED:
            by_step.setdefault(phase.step, []).append(number)
    rounds = []
    for numbers_of_step in by_step.values():
        numbers_of_step.sort(key=lambda number: (-found[number].tracked_time, number))
        first = apart(found, numbers_of_step)
        order = first + [number for number in numbers_of_step if number not in first]
        rounds += [(turn, number) for turn, number in enumerate(order)]
    return [found[number] for _, number in sorted(rounds, key=lambda pair: pair[0])]


def _phase_cells(phase, info, glyphs):
    a, b = phase.a, phase.b
    turn = atan2(b, a) / (2 * pi) % 1 if isfinite(a) and isfinite(b) else 0.0
    omega, v = STATES.get(phase.state, ''), ''
    if phase.state == LpPhase.TRACKED:
        omega = with_error(phase.omega, phase.omega_error)
        error = phase.velocity * phase.omega_error / abs(phase.omega) if phase.omega else -1.0
        v = with_error(phase.velocity, error)
    name = steps.wave_name('LP', phase, info)
    formula = waves.plain_formula(phase.nx, phase.ny, phase.modulation, phase.nz)
    hand = f'{hypot(a, b):.2f}', glyphs.dial(turn), f'{turn:.2f}'
    return (name, formula, phase.index, *hand, omega, v)


def cost(view, width, glyphs):
    """The parts of the wall time, and what limits the interval between orthonormalisations."""
    if view.cost is None or view.cost.wall_seconds <= 0:
        return []
    cells = []
    for part, spent in seconds(view.cost).items():
        share = spent / view.cost.wall_seconds
        cells.append(f'{part:<9} {glyphs.bar(share, PART_BAR)} {100 * share:3.0f} %')
    return flow(cells, width, '  ') + flow(_interval(view.cost), width)


def _interval(message):
    if message.orthonormalisations:
        yield f'interval {message.interval:.3g} ({LIMITS.get(message.interval_limit, "?")})'
        yield f'repairs {message.repairs}'
        yield f'condition {message.condition:.1e}'
        if isfinite(message.error_bound):
            yield f'error bound {message.error_bound:.1e}'
    if isfinite(message.events_per_second):
        yield f'{message.events_per_second:.2g} events/s'


def diagnosis(view):
    """The node's diagnostics, and whether it is still there."""
    lines = []
    if view.diagnosis is not None and not view.is_gone:
        name, style = LEVELS.get(view.diagnosis.level, ('?', 'error'))
        lines.append([(name, style), (f'  {view.diagnosis.message}', '')])
    if view.is_finished:
        return lines + [[('the run has finished', 'strong')]]
    if view.is_gone:
        said = f'  {view.node} does not answer; waiting for it to come back'
        lines.append([('GONE', 'error'), (said, '')])
    elif view.silence > 5:
        lines.append([(f'no message for {clock(view.silence)}', 'warn')])
    if view.is_master_gone:
        lines.append([('no master', 'error'), ('  connections from before stay', '')])
    return lines


def keys(view):
    asked = 'no more steps and phases' if view.wanted else 'compute steps and phases'
    return [[('q quit', 'faint')] + ([(f'   m {asked}', 'faint')] if _may_ask(view) else [])]


def _may_ask(view):
    known = view.info.observables if view.info else ()
    topics = [topic for topic in ('steps', 'lp_phases') if topic in known]
    return bool(topics) and not set(topics) <= set(view.others)


def _without(view, topic):
    name = 'steps' if topic == 'steps' else 'LP phases'
    if view.info is not None and topic not in view.info.observables:
        return []
    if topic in view.others or view.wanted:
        return _note(name, 'none yet')
    return _note(name, 'computed only while somebody listens; key m: listen')


def _note(name, text):
    return [[(f'  {name}: {text}', 'faint')]]


def _number(value):
    return f'{value:.2g}' if isfinite(value) and value >= 0 else '?'
