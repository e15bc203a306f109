"""Runs rosbag record for one bag. It ends before the disk is full, and says at the end what is in
the bag."""

import os
import re
import signal
import subprocess
import sys
import threading
import time

import rosbag
import rospy

from . import bags
from .scene import Refused

POLL = 0.2  # seconds between two looks
PATIENCE = 5.0  # seconds for the last lines
LEAST = '1G'  # default of the space that has to stay free
NEWS = 'Subscribing to '  # of every topic that there may be, not of those that there are
LINES = {'ROSCONSOLE_STDOUT_LINE_BUFFERED': '1'}
UNITS = {'': 1, 'k': 2**10, 'M': 2**20, 'G': 2**30}  # units that rosbag knows


class Space:
    """The space that has to stay free on the disk of a bag, written as for rosbag, e.g. 500M."""

    def __init__(self, text, path):
        found = re.fullmatch('([0-9]{1,12})([kMG]?)', text)
        if not found:
            raise Refused(f'min_space = {text}: must be a number of bytes, such as 500M or 2G')
        self.text, self._folder = text, os.path.dirname(path)
        self._least = int(found[1]) * UNITS[found[2]]

    @property
    def free(self):
        disk = os.statvfs(self._folder)
        return disk.f_frsize * disk.f_bavail

    @property
    def lacks(self):
        return self.free < self._least

    def __str__(self):
        free = f'{self.free / UNITS["M"]:.0f}M'
        return f'less than min_space = {self.text} is free in {self._folder}: {free}'


def record(program, path, space, words, came):
    """Records a bag. came: signals that have come, each of which asks for the end. Returns the exit
    status: 0 the bag is there, 1 it is missing or not complete."""
    if came:
        return 0
    command = [program, f'--output-name={path}', f'--min-space={space.text}', *words]
    process = subprocess.Popen(
        ['setpriv', '--pdeathsig', 'INT', *command],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, **LINES},
    )
    said = threading.Thread(target=_pass_on, args=[process.stdout], daemon=True)
    said.start()
    is_short = _wait(process, space, came)
    said.join(PATIENCE)
    return _say(path, is_short, process.returncode)


def _pass_on(lines):
    """Prints what rosbag says, but for what it would record if it were there."""
    for line in lines:
        if NEWS not in line:
            sys.stdout.write(line)
            sys.stdout.flush()


def _wait(process, space, came):
    """Waits for the end of the process, which gets each signal. Returns True if it ended for want
    of space."""
    heeded, is_short = 0, False
    while process.poll() is None:
        if not is_short and space.lacks:
            rospy.logerr('%s: the recording ends', space)
            is_short = True
            came.append(signal.SIGINT)
        if len(came) > heeded:
            heeded = len(came)
            process.send_signal(signal.SIGINT)
        time.sleep(POLL)
    return is_short


def _say(path, is_short, status):
    """Logs what is in the bag. Returns the exit status."""
    files = bags.in_the_way(path)
    parts = [file for file in files if not file.endswith(bags.WRITTEN)]
    count = sum(map(messages, parts))
    if not count:
        rospy.logfatal('nothing was recorded: %s', _emptiness(path, files))
        return 1
    is_whole = status == 0 and not is_short
    what = path if parts == [path] else f'{parts[0]} to {parts[-1]}'
    how = 'messages' if is_whole else 'messages, not up to the end of the run'
    say = rospy.loginfo if is_whole else rospy.logerr
    say('the bag is %s: %d %s; hdlyap plot draws its figures', what, count, how)
    return 0 if is_whole else 1


def _emptiness(path, files):
    if not files:
        return f'there is no {path}'
    cut = ', which was cut short' if files[-1].endswith(bags.WRITTEN) else ''
    return f'no message can be read in {files[-1]}{cut}'


def messages(path):
    """The number of messages of hdlyap in a bag."""
    try:
        with rosbag.Bag(path, skip_index=True) as bag:
            found = bag.get_type_and_topic_info().topics.values()
    except (rosbag.ROSBagException, OSError):
        return 0
    return sum(topic.message_count for topic in found if topic.msg_type.startswith('hdlyap/'))
