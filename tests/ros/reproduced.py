"""Parts of the reproduction over bags that are made."""

import os
import sys
import tempfile
import unittest

import yaml

import made
from hdlyap.plots.figures.style import STYLE, plt

STUDY = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../doc/reproduction')
sys.path.append(STUDY)

from study.bags import Bag  # noqa: E402
from study import table  # noqa: E402
from study.row import HEADER  # noqa: E402

PARTS, FRONT = table.read()


def plan():
    """{run: what is asked of it}, of the runs that the study needs."""
    with open(os.path.join(STUDY, 'runs.yaml')) as file:
        return yaml.safe_load(file)


def part_of(module):
    """The row of the table whose module it is."""
    return next(part for part in PARTS if part.module is module)


def claims(module, bags):
    """{name: Claim}, each with lines as long as their header."""
    found = {claim.name: claim for claim in part_of(module).claims(bags)}
    for claim in found.values():
        for line in claim.lines():
            assert len(line) == len(HEADER), line
    return found


class Part(unittest.TestCase):
    of = None  # the module of the part

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plt.close, 'all')
        self.folder = folder.name

    def bag(self, name, messages):
        path = os.path.join(self.folder, name + '.bag')
        made.write(path, messages)
        return Bag(path)

    def claims(self, bags):
        """{name: Claim}"""
        return claims(self.of, bags)

    def rows(self, bags):
        """{quantity: Row}"""
        rows = [row for claim in self.claims(bags).values() for row in claim.rows]
        found = {row.quantity: row for row in rows}
        self.assertEqual(len(found), len(rows))
        for row in rows:
            row.cells()
        return found

    def tables(self, bags):
        """{name: (header, lines)}, each line as long as its header."""
        found = {
            name: (header, [tuple(map(str, line)) for line in lines])
            for name, header, lines in self.of.tables(bags)
        }
        for header, lines in found.values():
            for line in lines:
                self.assertEqual(len(line), len(header))
        return found

    def figures(self, bags):
        """{name: figure}; each is drawn, and not in one colour."""
        with plt.rc_context(STYLE):
            found = dict(self.of.figures(bags))
            for figure in found.values():
                figure.canvas.draw()
                pixels = memoryview(figure.canvas.buffer_rgba())
                self.assertGreater(len(set(bytes(pixels)[::4])), 1)
        return found

    def measures_nothing(self, bags):
        """What a bag without the topics gives."""
        for row in self.rows(bags).values():
            self.assertEqual(row.verdict, 'not measured', row.quantity)
        self.assertEqual(self.figures(bags), {})
        self.tables(bags)
