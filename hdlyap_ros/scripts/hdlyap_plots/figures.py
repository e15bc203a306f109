"""Recording -> spectrum, convergence and cost figures, as PNG and SVG."""

import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt     # noqa: E402
from matplotlib import ticker       # noqa: E402
import numpy as np                  # noqa: E402

from . import paper                 # noqa: E402
from .recording import STAGES, known    # noqa: E402

MAGNIFIED = 40      # smallest exponents in the second panel of the spectrum
POINTS = 2000       # of a curve; more cannot be seen
# Okabe and Ito's palette, safe for colour-blind readers
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY = (
    '#0072B2', '#E69F00', '#009E73', '#D55E00', '#CC79A7', '#56B4E9')
GREY, INK = '#8C8C8C', '#1A1A1A'
KIND_COLOURS = {'T': BLUE, 'LP': VERMILION}
STAGE_LABELS = {'events': 'events', 'replay': 'tangent replay', 'ortho': 'orthonormalisation',
                'spectrum': 'averages', 'publish': 'publishing', 'other': 'other'}
STAGE_COLOURS = {'events': BLUE, 'replay': SKY, 'ortho': ORANGE, 'spectrum': GREEN,
                 'publish': PURPLE, 'other': '#BFBFBF'}
PHASES = ('equilibration', 'warm-up', 'averaging')
STYLE = {'font.size': 9, 'axes.titlesize': 9, 'axes.labelsize': 9, 'legend.fontsize': 8,
         'xtick.labelsize': 8, 'ytick.labelsize': 8, 'xtick.direction': 'in',
         'ytick.direction': 'in', 'xtick.top': True, 'ytick.right': True, 'axes.linewidth': 0.7,
         'lines.linewidth': 1.2, 'legend.frameon': False, 'mathtext.fontset': 'dejavusans',
         'svg.hashsalt': 'hdlyap'}


def draw_all(recording, folder):
    """Every figure that the recording has data for; the names of the files written."""
    files = []
    with plt.rc_context(STYLE):
        if recording.spectrum is not None:
            files += _save(_spectrum(recording), folder, 'spectrum')
            files += _save(_convergence(recording), folder, 'convergence')
        if recording.cost() is not None:
            files += _save(_cost(recording), folder, 'cost')
    return files


def _save(figure, folder, name):
    """Complete files only: a good older one is replaced in one step."""
    files = []
    for suffix, options in (('png', {'dpi': 250}), ('svg', {'metadata': {'Date': None}})):
        path = os.path.join(folder, f'{name}.{suffix}')
        unfinished = os.path.join(folder, f'.{name}.{os.getpid()}.{suffix}')
        try:
            figure.savefig(unfinished, **options)
            os.replace(unfinished, path)
        finally:
            if os.path.exists(unfinished):
                os.remove(unfinished)
        files.append(path)
    plt.close(figure)
    return files


def _spectrum(recording):
    if _magnified_range(recording) == (recording.spectrum.first_index, recording.last_index):
        figure, small = plt.subplots(figsize=(4.6, 4.0), constrained_layout=True)
    else:
        figure, (whole, small) = plt.subplots(1, 2, figsize=(7.2, 4.0), constrained_layout=True,
                                              gridspec_kw={'width_ratios': [1, 1.45]})
        _whole_spectrum(whole, recording)
        small.set_title('(b) smallest exponents', loc='left')
    _small_exponents(small, recording)
    info = recording.info
    figure.suptitle(f'{info.scene}: $N={info.disks}$, $\\rho={info.density:g}$, '
                    f'$L_y/L_x={info.aspect:g}$, averaged over '
                    f'{recording.spectrum.averaged_time:g} time units', fontsize=9)
    return figure


def _whole_spectrum(axes, recording):
    spectrum = recording.spectrum
    indices = np.arange(spectrum.first_index, recording.last_index + 1)
    axes.errorbar(indices, spectrum.exponents, _bars(spectrum.std_errors), fmt='.', color=INK,
                  ecolor=GREY, markersize=2, elinewidth=0.7, rasterized=True)
    _exponent_axes(axes)
    axes.set_title('(a) all exponents carried', loc='left')
    _frame_magnified(axes, recording)


def _bars(std_errors):
    """Lengths of error bars; None if not one is known."""
    errors = known(std_errors)
    return errors if np.isfinite(errors).any() else None


def _exponent_axes(axes):
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.xaxis.set_major_locator(ticker.MaxNLocator(nbins=8, integer=True, steps=[1, 2, 5, 10]))
    axes.set_xlabel(r'index $\ell$')
    axes.set_ylabel(r'$\lambda_\ell$  [1/time unit]')


def _frame_magnified(axes, recording):
    """A light frame round what panel (b) shows."""
    first, last = _magnified_range(recording)
    offset = recording.spectrum.first_index
    inside = recording.spectrum.exponents[first - offset:last + 1 - offset]
    low, high = min(0, *inside), max(inside)
    axes.add_patch(plt.Rectangle((first, low), last - first, high - low, fill=False,
                                 edgecolor=VERMILION, linewidth=0.8, zorder=4))


def _magnified_range(recording):
    """First and last index of the panel of small exponents: those before the zeros, and where
    more are carried as many behind them."""
    spectrum = recording.spectrum
    end = min(recording.positive_end, recording.last_index)
    first = max(spectrum.first_index, end - MAGNIFIED + 1)
    last = min(recording.last_index, 4 * recording.info.disks + 1 - first)
    return first, last


def _small_exponents(axes, recording):
    spectrum = recording.spectrum
    first, last = _magnified_range(recording)
    steps = [step for step in paper.steps(recording.info)
             if first <= step.first and step.last <= last]
    for step in steps:
        _draw_step(axes, step)
    for index in range(first, last + 1):
        i = index - spectrum.first_index
        axes.errorbar(index, spectrum.exponents[i], _bars(spectrum.std_errors[i]), fmt='o',
                      color=_colour(index, steps), markersize=2.6, elinewidth=0.8, capsize=1.5)
    _exponent_axes(axes)
    if steps:
        _step_legend(axes)


def _colour(index, steps):
    kinds = [step.kind for step in steps if step.first <= index <= step.last]
    return KIND_COLOURS[kinds[0]] if kinds else INK


def _draw_step(axes, step):
    """The fitted value as a band a little wider than the step, its name before it."""
    colour = KIND_COLOURS[step.kind]
    low, high = (step.fitted * (1 + sign * paper.FIT_ACCURACY) for sign in (-1, 1))
    axes.fill_between([step.first - 1.2, step.last + 1.2], low, high, color=colour, alpha=0.2,
                      linewidth=0)
    axes.annotate(step.name, (step.first - 1.2, step.fitted), xytext=(-3, 0),
                  textcoords='offset points', color=colour, fontsize=7, ha='right', va='center')


def _step_legend(axes):
    patches = [matplotlib.patches.Patch(color=KIND_COLOURS[kind], alpha=0.2, label=label)
               for kind, label in (('T', r'$c_T k \pm 3$ %'), ('LP', r'$c_L k \pm 3$ %'))]
    axes.legend(handles=patches, loc='upper right', title='Eckmann et al. 2005',
                title_fontsize=8)


def _convergence(recording):
    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(5.2, 6.6), sharex=True,
                                                 constrained_layout=True)
    course = recording.course()
    kept = _thinned(len(course['time']))
    time = course['time'][kept]
    _with_error(top, time, course['lambda_max'][kept], course['lambda_max_error'][kept], INK)
    top.set_ylabel(r'$\lambda_{\max}$  [1/time unit]')
    for column, (index, colour) in enumerate(zip(recording.smallest,
                                                 (SKY, BLUE, ORANGE, VERMILION))):
        _with_error(middle, time, course['small'][kept, column],
                    course['small_errors'][kept, column], colour, rf'$\ell={index}$')
    middle.set_ylabel(r'$\lambda_\ell$  [1/time unit]')
    middle.legend(ncol=2)
    _largest_error(bottom, time, course['largest_error'][kept])
    bottom.set_ylabel('standard error  [1/time unit]')
    bottom.set_xlabel('averaged time  [time units]')
    bottom.set_xscale('log')
    for axes, name in zip((top, middle, bottom), 'abc'):
        axes.set_title(f'({name})', loc='left')
    return figure


def _thinned(count):
    return np.unique(np.linspace(0, count - 1, min(count, POINTS)).astype(int))


def _with_error(axes, time, mean, error, colour, label=None):
    if np.isfinite(error).any():
        axes.fill_between(time, mean - error, mean + error, color=colour, alpha=0.25, linewidth=0)
    axes.plot(time, mean, color=colour, label=label)


def _largest_error(axes, time, error):
    measured = np.isfinite(error)
    if not measured.any():
        axes.annotate('not yet known', (0.5, 0.5), xycoords='axes fraction', ha='center')
        return
    axes.loglog(time[measured], error[measured], color=INK, label='largest standard error')
    axes.loglog(time[measured], error[measured][-1] * np.sqrt(time[-1] / time[measured]), '--',
                color=GREY, label=r'$\propto 1/\sqrt{t}$')
    axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(ticker.FormatStrFormatter('%g'))
    axes.yaxis.set_minor_formatter(ticker.NullFormatter())
    axes.legend()


def _cost(recording):
    figure, (course, share) = plt.subplots(1, 2, figsize=(7.2, 3.2), constrained_layout=True,
                                           gridspec_kw={'width_ratios': [1.5, 1]})
    cost = recording.cost()
    cost['other'] = np.maximum(0, cost['wall'] - sum(cost[stage] for stage in STAGES))
    _cost_course(course, cost)
    _cost_shares(share, cost)
    return figure


def _cost_course(axes, cost):
    kept = _thinned(len(cost['time']))
    axes.stackplot(cost['time'][kept], *(cost[stage][kept] for stage in STAGE_LABELS),
                   colors=list(STAGE_COLOURS.values()), linewidth=0)
    for phase, name in enumerate(PHASES):
        during = cost['time'][cost['phase'] == phase]
        if during.size:
            axes.axvline(during[0], color=INK, linewidth=0.6, linestyle=':')
            axes.annotate(name, (during[0], 1), xycoords=('data', 'axes fraction'),
                          xytext=(6, -3), textcoords='offset points', rotation=90, fontsize=7,
                          va='top')
    axes.margins(0)
    axes.set_xlim(left=0)
    axes.set_xlabel('simulated time  [time units]')
    axes.set_ylabel('wall time since the start  [s]')
    axes.set_title('(a)', loc='left')


def _cost_shares(axes, cost):
    seconds = np.array([cost[stage][-1] for stage in STAGE_LABELS])
    rows = np.arange(len(seconds))
    axes.barh(rows, seconds, color=list(STAGE_COLOURS.values()))
    for row, value in zip(rows, seconds):
        axes.annotate(f'{value:.3g} s ({100 * value / cost["wall"][-1]:.1f} %)', (value, row),
                      xytext=(3, 0), textcoords='offset points', va='center', fontsize=8)
    axes.set_yticks(rows)
    axes.set_yticklabels(STAGE_LABELS.values())
    axes.tick_params(axis='y', length=0)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.9 * max(seconds))
    axes.set_xlabel('wall time  [s]')
    axes.set_title('(b) whole run', loc='left')
