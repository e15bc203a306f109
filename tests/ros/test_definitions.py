"""Bags whose definitions of messages somebody has made to do harm: genpy would run them."""

import os
import unittest

import rosbag

import made
import test_data_tools
from hdlyap.data import definitions, reader
from test_data_joined import HALF

GONE = '\x1b[2J'
BETWEEN = '\n' + '=' * 80 + '\n'


def under(message, text, md5sum='a' * 32):
    """The message as if it had that definition."""
    kind = type('Made', (type(message),), dict(_full_text=text, _md5sum=md5sum))
    copy = kind()
    for name in message.__slots__:
        setattr(copy, name, getattr(message, name))
    return copy


def doubled(depth):
    """Of two parts with two parts each, and so on."""
    parts = ['hdlyap/A0 x\nhdlyap/A0 y']
    parts += [f'MSG: hdlyap/A{k}\nhdlyap/A{k + 1} x\nhdlyap/A{k + 1} y' for k in range(depth)]
    return BETWEEN.join([*parts, f'MSG: hdlyap/A{depth}\nint32 x'])


class Definitions(test_data_tools.Tools):
    def setUp(self):
        super().setUp()
        self.trace = os.path.join(self.folder, 'trace')

    def refused(self, said, text, **md5sum):
        messages = [under(made.run_info(), text, **md5sum), made.spectrum(HALF, 50.0)]
        for status, _, error in self.all_tools(self.write(messages, 'a')):
            self.assertNotEqual(status, 0)
            self.assertIn('a.bag: damaged: ', error)
            self.assertIn(said, error)
        self.assertFalse(os.path.exists(self.trace), text)

    def test_programs(self):
        """In names and values, which stand in genpy's program as they are."""
        own, do = made.RunInfo._full_text, f'open("{self.trace}", "w")'
        for line in (f'string 1; {do}; X=a', f'int32 1; {do}; X=1', f'bool X={do}'):
            self.refused('its definition has a line', line + '\n' + own)
        within = f'string A="""; {do} #\n{own}\n# \\'
        self.refused('its definition has a backslash', within)
        self.refused('its definition has a part', f'{own}{BETWEEN}MSG: a/X({do}): #\nint32 x')

    def test_too_much(self):
        """A few lines that ask for gigabytes."""
        own = made.RunInfo._full_text
        self.refused('4000000000 fields', 'float64[4000000000] x')
        self.refused('a part of itself', 'hdlyap/RunInfo x\n' + own)
        self.refused(f'{2 ** 41} fields', doubled(40))
        self.refused('a definition of ', '# ' + 'x' * definitions.LARGEST + '\n' + own)

    def test_of_something_else(self):
        """rosbag would warn, with the names as they are."""
        own = made.RunInfo._full_text
        self.refused('not the one of md5sum aaaa', own)
        self.refused('not the one of md5sum', made.Cost._full_text, md5sum=made.RunInfo._md5sum)
        self.refused('md5sum ?[2J', own, md5sum=GONE)
        self.refused('', '')

    def test_constants_of_texts(self):
        """Are what they are, quotes and all."""
        text = 'string A=it\'s """x # y\nstring B = \nfloat32 C=-1e-3 # z\n' + made.Cost._full_text
        path = self.write([made.run_info(), made.defined(made.cost(1), lambda _: text)], 'a')
        cost = next(reader.messages(path, kinds=(reader.COST,))).message()
        self.assertEqual((cost.A, cost.B, cost.sim_time), ('it\'s """x # y', '', 1.0))

    def test_bags_of_ours(self):
        """With all types of messages."""
        with rosbag.Bag(self.write(made.small_run(), 'a')) as bag:
            definitions.check(bag._get_connections())


if __name__ == '__main__':
    unittest.main()
