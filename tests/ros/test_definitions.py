"""Bags with other definitions of messages than those that are installed: of another version, which
is named, or made to do harm, which rosbag would run."""

import os
import re

import made
import test_data_tools
from test_data_joined import HALF


def under(message, text, md5sum):
    """The message as if it had that definition."""
    kind = type('Made', (type(message),), dict(_full_text=text, _md5sum=md5sum))
    copy = kind()
    for name in message.__slots__:
        setattr(copy, name, getattr(message, name))
    return copy


def without(message, name):
    """As a version wrote it whose message has not that field."""
    return made.defined(message, lambda text: re.sub(rf'(?m)^\S+ {name}\b.*\n', '', text))


class Definitions(test_data_tools.Tools):
    def setUp(self):
        super().setUp()
        self.trace = os.path.join(self.folder, 'trace')

    def refused(self, said, messages):
        for status, _, error in self.all_tools(self.write(messages, 'a')):
            self.assertNotEqual(status, 0)
            self.assertRegex(error, rf'\A[^\n]*a\.bag: {said}[^\n]*\n\Z')

    def test_of_another_version(self):
        """It is named, as it is in each run_info; one without is of another."""
        spectrum = made.spectrum(HALF, 50.0)
        info, steps = made.run_info(version='0.0.7'), without(made.steps([]), 't_misfit')
        self.refused(
            'written by hdlyap 0.0.7, whose message hdlyap/Steps differs', [info, spectrum, steps]
        )
        old = without(info, 'box_z')
        self.refused(
            'written by hdlyap 0.0.7, whose message hdlyap/RunInfo differs', [old, spectrum]
        )
        self.refused('written by another version of hdlyap, whose', [spectrum, steps])
        info.version = '0\x1b[2J'
        self.refused('written by another version of hdlyap, whose', [info, spectrum, steps])

    def test_programs(self):
        """In names, values and the name of the type, which stand in genpy's program as they are."""
        own, do = made.RunInfo._full_text, f'open("{self.trace}", "w")'
        for line in (f'string 1; {do}; X=a', f'int32 1; {do}; X=1', f'string A="""; {do} #\\'):
            for md5sum in ('a' * 32, made.RunInfo._md5sum):
                info = under(made.run_info(), line + '\n' + own, md5sum)
                path = self.write([info, made.spectrum(HALF, 50.0)], 'a')
                for status, _, error in self.all_tools(path):
                    self.assertEqual(
                        'whose message hdlyap/RunInfo differs' in error, 'aaa' in md5sum, error
                    )
                self.assertFalse(os.path.exists(self.trace), line)
