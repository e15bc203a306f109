"""Frames -> a film of modes and moving particles: an MP4 or a GIF."""

import os
from subprocess import CalledProcessError

import matplotlib.style
import numpy as np
from matplotlib.animation import FFMpegWriter
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from hdlyap import whole
from hdlyap.data import space, steps
from hdlyap.data.reader import RecordingError
from hdlyap.numbers import known, with_error
from hdlyap.progress import Progress

from .figures.box import Particles, arrows
from .figures.style import BLUE, GREY, VERMILION, scene
from .figures.turning import LEFT, RIGHT, of_spins, of_vector, strength
from .figures.view import View

WIDTH = {'.mp4': 1280, '.gif': 480}  # pixels, for each kind of file
INCHES = 5.0  # the same width in inches, by which letters are sized
TOP, TITLE, GAP = 0.4, 0.45, 0.12  # inches: title of the film, of a panel, gap between panels
LINE = 0.14  # inches: another line of the film's title
LONG = 2.5  # panels of boxes longer than this lie above each other
BESIDE = 1.9  # inches: least width for the name of a mode and its dials
TALLEST = 6.0  # inches: largest height of a panel
ARROW, LONGEST = 1.3, 2.6  # root mean square and longest arrow, in mean distances of particles
ALL_L, ALL_P = to_rgb('#E69F00'), to_rgb('#661F05')  # LP mode that is all L, all P, as in rviz
DISK = '#DCDCDC'
SPHERE, DOT = '#8C8C8C', 0.3  # colour and diameter of spheres; larger ones would hide others
PALE = 0.3  # part of white in a vector of an earlier time
COLOURS, SHADES = 24, 64  # number of colours of a GIF, and if particles rotate
CODECS = {
    '.mp4': (
        'libx264',
        ['-pix_fmt', 'yuv420p', '-crf', '20', '-vf', 'pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:white'],
    ),
    '.gif': (
        'gif',
        [
            '-filter_complex',
            'split [a][b]; [a] palettegen=max_colors={colours} [p]; [b][p] paletteuse=dither=none',
        ],
    ),
}


class Panel:
    """The box with particles, and the vector of one mode."""

    def __init__(self, axes, name, film):
        info = film.info
        self._axes, self._name, self._film = axes, name, film
        self._distance, self._view = space.distance(info), View(info)
        style = dict(size=DOT) if self._view.is_solid else dict(facecolors=DISK, antialiaseds=False)
        zeros = np.zeros((len(space.axes(info)), info.number))
        self._particles = Particles(axes, info, zeros, zeros[0], **style)
        self._arrows = None
        self._colour = BLUE if name.startswith('T') else VERMILION
        axes.set_xticks([])
        axes.set_yticks([])
        self._title = axes.set_title('', fontsize=7.5, color=self._colour, loc='left')
        self._dials = []

    def show(self, frame):
        field = frame.fields.get(self._name)
        self._show_particles(frame, field)
        self._title.set_text(self._text(frame, field))
        if field is None:
            return
        dq = space.displacements(field, self._film.info)
        dq *= ARROW * self._distance / strength(field, self._film.info)
        lengths = np.maximum(np.linalg.norm(dq, axis=0), 1e-300)
        dq *= np.minimum(1, LONGEST * self._distance / lengths)
        q = space.vectors(field)
        order = self._view.order(q)
        q, dq = q[:, order], dq[:, order]
        if self._arrows is None:
            zeros = np.zeros_like(dq[:2])
            self._arrows = arrows(self._axes, *zeros, zeros, width=0.14 * self._distance)
        self._arrows.set_offsets(self._view.places(q - 0.5 * dq).T)
        self._arrows.set_UVC(*self._view.vectors(dq))
        pale = PALE if field.sim_time != frame.time else 0.0
        colour = mode_colour(field, frame.turned.get(self._name, ()))
        colour_now = mixed(colour, (1.0, 1.0, 1.0), pale)
        self._arrows.set_color(self._view.pale(colour_now, q))
        self._show_dials(frame, field, colour)

    def _show_particles(self, frame, field):
        """Shows the particles. Those that rotate are coloured by the vector or, without one, by
        their spin."""
        info, order = self._film.info, self._view.order(frame.places)
        q = frame.places[:, order]
        self._particles.move(q, frame.angles, order)
        if self._view.is_solid:
            self._particles.paint(self._view.pale(SPHERE, q))
        elif space.turns(info):
            known = field is not None
            self._particles.paint(
                of_vector(field, info, DISK) if known else of_spins(info, frame.spins, DISK)
            )

    def _text(self, frame, field):
        step = self._film.steps.get(self._name)
        if field is None:
            return f'{self._name}: not resolved yet'
        number = f'{field.exponent:.4f}'
        if step is not None:
            number = with_error(step.exponent, known(step.std_error))
        of = f' of $t={field.sim_time:.1f}$' if field.sim_time != frame.time else ''
        return f'{self._name}   $\\lambda={number}$\nvector {field.index}{of}'

    def _show_dials(self, frame, field, colour):
        """Shows (a, b) of each pair in a unit circle, above the panel at the right."""
        pairs = frame.pairs(field) if field.kind == steps.LP else []
        while len(self._dials) < len(pairs):
            self._dials.append(dial(self._axes, len(self._dials)))
        for hand, (a, b) in zip(self._dials, pairs):
            hand.set_segments([[(0, 0), (a, b)]])
            hand.set_color([colour])


def dial(axes, number):
    """Draws a dial above the axes, beside the name of the mode. Returns its hand."""
    box = axes.figure.transFigure.inverted().transform_bbox(axes.get_window_extent())
    size = 0.22 / axes.figure.get_figheight()
    across = size * axes.figure.get_figheight() / axes.figure.get_figwidth()
    right = max(box.x1, box.x0 + BESIDE / axes.figure.get_figwidth())
    left = right - (number + 1) * 1.35 * across
    inset = axes.figure.add_axes([left, box.y1 + 0.25 * size, across, size])
    inset.set_axis_off()
    inset.set_xlim(-1.05, 1.05)
    inset.set_ylim(-1.05, 1.05)
    inset.add_patch(Circle((0, 0), 1, fill=False, edgecolor=GREY))
    inset.text(1.2, 0, 'a', fontsize=5, va='center')
    inset.text(0, 1.15, 'b', fontsize=5, ha='center')
    hand = LineCollection([], linewidths=2.5)
    inset.add_collection(hand)
    return hand


def mixed(one, other, part):
    return tuple((1 - part) * a + part * b for a, b in zip(one, other))


def mode_colour(field, pairs):
    """The colour of a mode. An LP mode turns from L to P, and its hue shows how far."""
    if field.kind == steps.T:
        return to_rgb(BLUE)
    squares = np.sum(np.square(pairs), axis=0) if len(pairs) else np.zeros(2)
    if squares.sum() <= 0:
        return to_rgb(VERMILION)
    return mixed(ALL_L, ALL_P, squares[1] / squares.sum())


class Picture:
    """A figure with a panel for each mode, which shows one frame after the other."""

    def __init__(self, film, width):
        count = len(film.names)
        wide, tall = View(film.info).size
        rows, columns = (count, 1) if wide > LONG * tall else (1, count)
        cell = (INCHES - GAP * (columns + 1)) / columns
        across = min(cell, TALLEST * wide / tall)
        high = across * tall / wide
        top = TOP + LINE * scene(film.info).count('\n')
        height = top + rows * (high + TITLE)
        dpi = (width + 0.5) / INCHES  # matplotlib cuts the width to a whole number
        self.figure, look = Figure(figsize=(INCHES, height), dpi=dpi), {'va': 'top', 'fontsize': 8}
        FigureCanvasAgg(self.figure)
        self._title = self.figure.text(0.5, 1 - 0.08 / height, '', ha='center', **look)
        for name, colour, place in self._legend(film):
            at = place / INCHES, 1 - 0.22 / height
            self.figure.text(*at, f'\u25cf {name}', color=colour, ha='right', **look)
        self._film, self._panels = film, []
        for k, name in enumerate(film.names):
            row, column = divmod(k, columns)
            left = GAP + column * (cell + GAP)
            bottom = height - top - (row + 1) * (high + TITLE) + GAP
            room = left / INCHES, bottom / height, across / INCHES, high / height
            self._panels.append(Panel(self.figure.add_axes(room), name, film))

    @staticmethod
    def _legend(film):
        """Yields (text, colour, right end [inch])."""
        if any(name.startswith('LP') for name in film.names):
            yield 'L', ALL_L, INCHES - GAP - 0.3
            yield 'P', ALL_P, INCHES - GAP
        if space.turns(film.info):
            yield 'turns left', LEFT, GAP + 0.6
            yield 'right', RIGHT, GAP + 1.05

    def show(self, frame):
        self._title.set_text(f'{scene(self._film.info)}\n$t={frame.time:.1f}$')
        for panel in self._panels:
            panel.show(frame)


def write(film, path, pace, fps, width=None):
    """Writes a film. Returns the number of frames. An older file is replaced in one step, by a
    complete film."""
    suffix = os.path.splitext(path)[1]
    every = pace / fps
    if not FFMpegWriter.isAvailable():
        raise RecordingError('there is no ffmpeg; install it (Debian and Ubuntu: ffmpeg)')
    codec, options = CODECS[suffix]
    options = [one.format(colours=SHADES if space.turns(film.info) else COLOURS) for one in options]
    writer, total = FFMpegWriter(fps, codec, extra_args=options), film.count(every)
    try:
        # the look of a film does not depend on the user's matplotlibrc
        with matplotlib.style.context('default'), whole.written(path) as unfinished:
            picture = Picture(film, width or WIDTH[suffix])
            with writer.saving(picture.figure, unfinished, picture.figure.dpi):
                for frame in Progress('drawing').over(film.frames(every), total):
                    picture.show(frame)
                    writer.grab_frame()
    except CalledProcessError as error:
        raise RecordingError(f'{path}: ffmpeg failed: {error.stderr or error}')
    return total
