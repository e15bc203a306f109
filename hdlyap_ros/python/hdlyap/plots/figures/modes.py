"""Vector fields of the modes with the smallest exponents, one for each step, in the plane. For
spheres see solid_modes."""

import numpy as np

from hdlyap.data import space, steps
from hdlyap.numbers import known, with_error

from . import page, solid_modes
from .box import Particles, arrows
from .style import GREY, INK, LIGHT, MEMBER_COLOURS, kind_colour, scene
from .turning import of_vector, strength

ORDER = 5

PANELS = 6
WIDTH = 7.2  # width of the figure [inch]
TALLEST = 9.0
LINE = 0.2  # height of another line of the title [inch]
LONG = 22  # longer names do not fit above a panel in the usual size
ALONE = 4.2  # width of a figure with one panel [inch]
MANY = 10000  # more arrows than this are pixels, as curves would fill megabytes of an SVG file
ARROW = 1.3  # root mean square length of the arrows [sigma]
CHANNEL = 2.0  # a box narrower than this, in sigma, has no room for arrows


class Panel:
    """A vector and the set to which it belongs, no set if it belongs to no step; the error of its
    exponent. `dq`: what is drawn, of an LP step its L part, as whole vectors look random at times
    when most of them is in P."""

    def __init__(self, field, info, block=None, error=np.nan):
        self.field, self.info, self.block, self.error = field, info, block, error
        self.dq, self.said = space.displacements(field, info), ''

    def show_l(self):
        """Takes the L part in place of dq, if the step has modes of its own."""
        if self.block and self.block.kind == steps.LP and self.field.pairs:
            part, share = l_part(self.field)
            self.dq = part / space.roots(self.info)
            self.said = f', L part ({100 * share:.0f} %)'
        return self

    @property
    def arrows(self):
        """dq as arrows of a root mean square length of ARROW, but of what turns its whole."""
        drawn = np.sqrt(np.mean(np.sum(self.dq**2, axis=0)))
        return self.dq * ARROW / (drawn if self.said else strength(self.field, self.info))

    @property
    def name(self):
        return self.block.name if self.block else 'no step'

    @property
    def title(self):
        value = with_error(self.field.exponent, self.error, decimals=4)
        return f'{self.name}{self.said}, $\\ell={self.field.index}$, $\\lambda={value}$'

    @property
    def colour(self):
        return kind_colour(self.block.kind) if self.block else GREY


def l_part(field):
    """The projection of dq on the L modes of its step, and its share of the square of dq."""
    dq = space.vectors(field, 'dq')
    found = space.vectors(field, 'l_').reshape(len(dq), field.pairs, -1)
    found = np.moveaxis(found, 1, 2).reshape(-1, field.pairs)
    part = found @ np.linalg.lstsq(found, dq.ravel(), rcond=None)[0]
    return part.reshape(dq.shape), np.sum(part**2) / np.sum(dq**2)


@page.figure
def draw(page, recording, **look):
    panels = [panel.show_l() for panel in chosen(recording)]
    if not panels:
        return
    info, more = recording.info, f'\n$t={panels[0].field.sim_time:g}$: $\\delta q$'
    if space.is_solid(info):
        drawn = solid_modes.draw_panels(page, panels, info, look)
    elif min(info.box_x, info.box_y) < CHANNEL:
        drawn = _channel(page, panels, info, look)
    else:
        drawn = draw_panels(page, panels, info, look)
        colours = ', green: turned to the left, purple: to the right'
        more += colours if space.turns(info) else ''
    page.title(info, *(drawn if len(drawn) > 1 else ()), more=more)


def chosen(recording):
    """Panels of the latest field of each set, smallest exponents first; then of vectors that the
    user has chosen by index and that belong to no set."""
    panels, others = _latest(recording)
    # if there is a field for each step, a vector without a step had one only for a while
    if recording.info.field_indices != 'steps':
        panels += [panel for panel in others if panel.field.index <= recording.positive_end]
    return panels[:PANELS]


def named(recording, names):
    """Panels of the latest field of each of these steps, unless it shares its set."""
    panels = {panel.name: panel for panel in _latest(recording)[0]}
    return [panels[name] for name in names if name in panels]


def _latest(recording):
    """Panels of the latest field of each set, and panels of vectors that belong to no step."""
    latest, others = {}, []
    blocks = steps.blocks(recording.steps, recording.info)
    for field in recording.fields():
        block = next((block for block in blocks if block.first <= field.index <= block.last), None)
        if block is None:
            others.append(Panel(field, recording.info, error=_error(recording, field)))
        elif block.first not in latest or field.sim_time > latest[block.first].field.sim_time:
            latest[block.first] = Panel(field, recording.info, block, _error(recording, field))
    return [latest[block.first] for block in blocks if block.first in latest], others


def _error(recording, field):
    """The error of the exponent of a vector; NaN if it is not known."""
    spectrum = recording.spectrum
    place = field.index - spectrum.first_index if spectrum else -1
    return float(known(spectrum.std_errors[place])) if place >= 0 else np.nan


def draw_panels(page, panels, info, look=()):
    """Draws the arrows of each panel. Returns their axes."""
    columns = _columns(len(panels), info)
    rows = -(-len(panels) // columns)
    width = WIDTH if len(panels) > 1 else ALONE
    width = page.widest if page.is_narrow else width
    height = rows * (width / columns * info.box_y / info.box_x + 0.3) + 0.5
    is_broken = page.is_narrow and columns > 1
    height += LINE * (rows if is_broken else 0 if page.is_narrow else scene(info).count('\n'))
    size = width, min(height, TALLEST)
    letters = 9 - columns if max(len(one.name + one.said) for one in panels) >= LONG else 8
    grid = page.panels(rows, columns, *size, squeeze=False, is_box=True)
    for axes, panel in zip(grid.flat, panels):
        _arrows(axes, panel, info, {'rasterized': len(panels) * info.number > MANY, **dict(look)})
        title = panel.title.replace(', $\\ell', ',\n$\\ell') if is_broken else panel.title
        axes.set_title(title, fontsize=7 if page.is_narrow else letters, loc='left')
        axes.set_xlabel(r'$x$  [$\sigma$]', fontsize=7)
        axes.set_ylabel(r'$y$  [$\sigma$]', fontsize=7)
    page.outer(grid)
    for column, lowest in zip(grid.T, _lowest(len(panels), columns)):
        column[lowest].set_xlabel(r'$x$  [$\sigma$]', fontsize=7)
    for axes in grid.flat[len(panels) :]:
        axes.set_axis_off()
    return grid.flat[: len(panels)]


def _columns(count, info):
    """The number of columns with which panels are large and fill the width of the page."""

    def size(columns):
        rows = -(-count // columns)
        of_panel = min(WIDTH / columns / info.box_x, TALLEST / rows / info.box_y)
        return of_panel * np.sqrt(of_panel * columns * info.box_x / WIDTH)

    return max(range(1, min(count, 3) + 1), key=lambda columns: (size(columns), columns))


def _lowest(count, columns):
    """The row of the last panel in each column."""
    return [(count - 1 - column) // columns for column in range(columns)]


def _arrows(axes, panel, info, look):
    field = panel.field
    rims = {'facecolors': 'none', 'edgecolors': LIGHT, 'linewidths': 0.4}
    drawn = Particles(axes, info, space.vectors(field), field.angle, **rims)
    if space.turns(info):
        drawn.paint(of_vector(field, info, 'white'))
    arrows(axes, field.x, field.y, panel.arrows, **{'width': 0.13, 'color': panel.colour, **look})
    axes.tick_params(labelsize=6, length=2)


def _channel(page, panels, info, look):
    """Draws vectors in a channel: their components over the coordinate along it, normalised to a
    mean square of one. Returns the axes."""
    alike = {'sharex': True, 'sharey': True, 'squeeze': False}
    rows = page.panels(len(panels), 1, WIDTH, 1.35 * len(panels) + 0.6, **alike)
    along = 'x' if info.box_x >= info.box_y else 'y'
    for axes, panel in zip(rows.flat, panels):
        field = panel.field
        dq = [*space.displacements(field, info), *[np.array(field.dq_angle)] * space.turns(info)]
        names = 'x', 'y', r'\phi'
        for component, name, colour, marker in zip(dq, names, MEMBER_COLOURS, 'os^'):
            component = component / strength(field, info)
            style = {'markersize': 3, 'color': colour, **look, 'label': rf'$\delta q_{{{name}}}$'}
            axes.plot(getattr(field, along), component, marker, **style)
        if panel.said:
            place = np.array(getattr(field, along))
            order = np.argsort(place)
            l_along = panel.dq['xy'.index(along)] / strength(field, info)
            axes.plot(place[order], l_along[order], color=INK, label='L part')
        axes.axhline(0, color=GREY, linewidth=0.5)
        axes.set_title(panel.title, fontsize=8, loc='left')
        axes.set_xlim(0, max(info.box_x, info.box_y))
        axes.set_ylabel(r'$\delta q$ / rms', fontsize=7)
        axes.set_xlabel(rf'${along}$  [$\sigma$]')
    close = {'borderpad': 0, 'handletextpad': 0.2, 'columnspacing': 1}
    named = max(
        (axes.get_legend_handles_labels() for axes in rows.flat), key=lambda one: len(one[1])
    )
    rows.flat[0].legend(*named, ncol=4, loc='lower right', bbox_to_anchor=(1, 0.97), **close)
    page.outer(rows)
    return rows.flat
