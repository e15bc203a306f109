"""The figures of a run side by side in a window, which the caller can draw anew."""

import time
import tkinter

from matplotlib.backends.backend_tkagg import FigureCanvasTkAgg
from matplotlib.figure import Figure

from .figures import FIGURES
from .figures.style import ours

# figure: row, column, rows
PLACES = {
    'spectrum': (0, 0, 1),
    'dispersion': (1, 0, 1),
    'steps': (0, 1, 1),
    'phases': (1, 1, 1),
    'convergence': (0, 2, 2),
}
COLUMNS, ROWS = (7, 6, 5), (1, 1)  # relative widths of columns, heights of rows
INCHES = 10.6  # the height of the window in inches, so that letters grow with it
SMALLEST = 60  # pixels of an edge below which no figure is drawn
PART = 0.9  # part of the screen that the window takes at first
TICK = 0.02  # seconds between two looks at what the user does


class Window:
    """is_open until the user closes it, which pause() notices."""

    def __init__(self, title):
        """Creates the window, but does not show it. Raises tkinter.TclError without a screen."""
        self._root = tkinter.Tk(className='hdlyap')
        self._root.withdraw()
        self._root.title(title)
        self._root.geometry(self._size())
        self._root.protocol('WM_DELETE_WINDOW', self.close)
        self._root.bind('q', lambda _: self.close())
        self._words = tkinter.StringVar(self._root)
        self._canvases = {name: self._canvas(*place) for name, place in PLACES.items()}
        self._share()
        self.is_open = True

    def _size(self):
        wide, high = self._root.winfo_screenwidth(), self._root.winfo_screenheight()
        return f'{int(PART * wide)}x{int(PART * high)}'

    def _canvas(self, row, column, rows):
        canvas = FigureCanvasTkAgg(Figure(), self._root)
        widget = canvas.get_tk_widget()
        widget.configure(width=1, height=1)  # it grows to its place, whatever its figure wants
        widget.grid(row=row, column=column, rowspan=rows, sticky='nsew')
        return canvas

    def _share(self):
        for column, share in enumerate(COLUMNS):
            self._root.columnconfigure(column, weight=share, uniform='columns')
        for row, share in enumerate(ROWS):
            self._root.rowconfigure(row, weight=share, uniform='rows')
        words = tkinter.Label(self._root, textvariable=self._words, anchor='w', padx=8)
        words.grid(row=len(ROWS), columnspan=len(COLUMNS), sticky='ew')

    def open(self):
        self._root.deiconify()
        self._root.update()

    def close(self):
        self.is_open = False
        self._root.withdraw()

    def pause(self, seconds):
        """Lets the user resize or close the window for this time."""
        until = time.monotonic() + seconds
        while self.is_open and time.monotonic() < until:
            self._root.update()
            time.sleep(TICK)

    def say(self, words):
        """Writes a text below the figures."""
        self._words.set(words)

    def draw(self, recorded):
        for name, canvas in self._canvases.items():
            with ours():
                page = FIGURES[name].draw(recorded)
                self._show(canvas, page.figure if page else _none(name))

    def _show(self, canvas, figure):
        widget = canvas.get_tk_widget()
        if min(widget.winfo_width(), widget.winfo_height()) < SMALLEST:
            return  # no room for a figure; it comes when the window is larger
        dpi = self._root.winfo_height() / INCHES
        figure.set_dpi(dpi)
        figure.set_size_inches(widget.winfo_width() / dpi, widget.winfo_height() / dpi)
        figure.set_canvas(canvas)
        canvas.figure = figure
        canvas.draw()


def _none(what):
    figure = Figure()
    figure.text(0.5, 0.5, f'no {what} yet', ha='center', va='center')
    return figure
