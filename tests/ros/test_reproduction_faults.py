"""Each statement of the reproduction turns red by a fault of the program that is planted in what it
recorded of a made world."""
# Second tier: tests/run.sh --all

import fnmatch
import functools
import unittest

from planted import FAULTS
from reproduced import PARTS, Bag, messages_of, of_part, plan, world

AGREES, DIFFERS = 'agrees', 'differs'


def verdicts(bags, parts=PARTS):
    """{statement: verdict}, of those that are judged."""
    found = [one for part in parts for one in part.claims(of_part(part, bags))]
    return {one.name: one.verdict for one in found if one.judged}


@functools.lru_cache(None)
def usual():
    return verdicts(world())


def touched(pattern):
    return [
        name for name in plan() if any(fnmatch.fnmatch(name, one) for one in pattern.split('|'))
    ]


def turned_by(fault):
    """{statement: its verdict} of those that turn red, or from red to green."""
    _, pattern, change, _ = fault
    names = touched(pattern)
    bags = {**world(), **{name: Bag(change(messages_of(name)), name) for name in names}}
    found = verdicts(bags, [part for part in PARTS if set(names) & set(part.runs)])
    turned = {name: one for name, one in found.items() if one != usual()[name]}
    return {name: one for name, one in turned.items() if one in (AGREES, DIFFERS)}


class Faults(unittest.TestCase):
    def test_none(self):
        """But for the paper's 3.20, and for a guess of ours that T modes do not follow."""
        off = {name for name, verdict in usual().items() if verdict == DIFFERS}
        names = (
            '3.20 is a quarter of a period',
            'a guess: T between walls is higher, as it is denser inside',
        )
        self.assertEqual(off, set(names))
        self.assertNotIn('not measured', usual().values())

    def test_each_turns_its_statements(self):
        turned_once = set()
        for fault in FAULTS:
            found = turned_by(fault)
            turned_once |= set(found)
            expected = {}
            for starts, verdict in zip(fault[3].split('>'), (DIFFERS, AGREES)):
                starts = tuple(one.strip() for one in starts.split(';') if one.strip())
                expected.update((name, verdict) for name in usual() if name.startswith(starts))
            with self.subTest(fault[0]):
                self.assertEqual(found, expected)
        self.assertEqual(turned_once, set(usual()))


if __name__ == '__main__':
    unittest.main()
