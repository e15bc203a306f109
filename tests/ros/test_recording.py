"""What the recorder says at its end, of a rosbag that does this or that."""

import os
import shlex
import signal
from unittest import mock

from diagnostic_msgs.msg import DiagnosticArray
import rosbag

import harness
import made
from bags import process
from hdlyap.runs import recording
from hdlyap.runs.scene import Refused

CLOSED, MOVED = 'cp {made} {bag}', 'cp {made} {stem}_0.bag; cp {made} {stem}_1.bag'
ALL = 'the bag is {bag}: 2 messages; hdlyap plot draws its figures'
PART = 'the bag is {bag}: 2 messages, not up to the end of the run; hdlyap plot draws its figures'
NOTHING = 'nothing was recorded: '
# what rosbag does, what is said of it, the exit status
ENDS = (
    (CLOSED, ALL, 0),
    (MOVED, ALL.replace('{bag}: 2', '{stem}_0.bag to {stem}_1.bag: 4'), 0),
    (CLOSED + '; exit 1', PART, 1),
    ('true', NOTHING + 'there is no {bag}', 1),
    ('cp {foreign} {bag}', NOTHING + 'no message can be read in {bag}', 1),
    ('echo > {bag}', NOTHING + 'no message can be read in {bag}', 1),
    (
        'cp {made} {bag}.active; kill -KILL $$',
        NOTHING + 'no message can be read in {bag}.active, which was cut short',
        1,
    ),
)
UNTIL_ASKED = 'trap "%s; exit 0" INT; echo > {stem}.ready; while true; do sleep 0.05; done' % CLOSED


class Recording(harness.InFolder):
    def setUp(self):
        super().setUp()
        made.write(self.path('made'), [made.run_info(), made.spectrum([1.0], 1.0)])
        with rosbag.Bag(self.path('foreign'), 'w') as bag:
            bag.write('/diagnostics', DiagnosticArray(), made.rospy.Time(1))

    def recorded(self, name, does, came=(), least='0'):
        """(exit status, what is said last) of a program in place of rosbag."""
        places = {key: shlex.quote(self.path(key)) for key in ('made', 'foreign')}
        bag, stem = self.path(name + '.bag'), self.path(name)
        program = self.path('program')
        with open(program, 'w') as file:
            file.write('#!/bin/bash\n' + does.format(bag=bag, stem=stem, **places))
        os.chmod(program, 0o755)
        self.said = []
        with mock.patch.object(recording, 'rospy') as log:
            for level in ('loginfo', 'logerr', 'logfatal'):
                getattr(log, level).side_effect = lambda text, *of: self.said.append(text % of)
            space = recording.Space(least, bag)
            status = recording.record(program, bag, space, [], came)
        return status, self.said[-1] if self.said else ''

    def test_what_is_said(self):
        for k, (does, words, status) in enumerate(ENDS):
            with self.subTest(does=does):
                wanted = words.format(bag=self.path(f'{k}.bag'), stem=self.path(str(k)))
                self.assertEqual(self.recorded(str(k), does), (status, wanted))

    def test_asked_to_end_first(self):
        self.assertEqual(self.recorded('x', CLOSED, [signal.SIGINT]), (0, ''))

    def when_ready(self, change):
        """Instead of a pause between two looks."""

        def sleep(seconds):
            if os.path.exists(self.path('x.ready')):
                change()

        return mock.patch.object(recording.time, 'sleep', side_effect=sleep)

    def test_asked_to_end(self):
        """rosbag is; what is whole by then is all of it."""
        came = []
        with self.when_ready(lambda: came or came.append(signal.SIGTERM)):
            ended = self.recorded('x', UNTIL_ASKED, came)
        self.assertEqual(ended, (0, ALL.format(bag=self.path('x.bag'))))

    def test_space_runs_short(self):
        """The recording ends in order; who has asked for it hears how much must be free."""
        with mock.patch.object(recording.os, 'statvfs') as disk:
            disk.return_value.f_frsize, disk.return_value.f_bavail = 2**10, 2**20

            def fill():
                disk.return_value.f_bavail = 2**20 - 1

            with self.when_ready(fill):
                ended = self.recorded('x', UNTIL_ASKED, [], '1G')
        self.assertEqual(ended, (1, PART.format(bag=self.path('x.bag'))))
        self.assertEqual(
            self.said[0],
            f'less than min_space = 1G is free in {self.folder}: 1024M: the recording ends',
        )

    def test_sizes(self):
        """As rosbag reads them; of others it takes none, or the beginning."""
        with mock.patch.object(recording.os, 'statvfs') as disk:
            disk.return_value.f_frsize = 1
            for text, least in {'7': 7, '3k': 3 << 10, '500M': 500 << 20, '2G': 2 << 30}.items():
                space = recording.Space(text, '/x.bag')
                for free, lacks in ((least - 1, True), (least, False)):
                    disk.return_value.f_bavail = free
                    self.assertIs(space.lacks, lacks, text)
        for text in ('', '1T', '1.5G', '-1G', 'G', '1 G', '1GB'):
            with self.assertRaisesRegex(Refused, '^min_space = .*: must be a number of bytes'):
                recording.Space(text, '/x.bag')

    def test_help(self):
        said = process('--help', script='record')
        self.assertEqual((said.status, said.error), (0, ''))
        self.assertIn('default: 1G', said.out)
