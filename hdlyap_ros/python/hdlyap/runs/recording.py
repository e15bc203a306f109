"""rosbag record of one bag, looked after: there is room for it, and at its end it is said what is
in it."""

import os
import re
import signal
import subprocess
import time

import rosbag
import rospy

from . import bags
from .scene import Refused

POLL = 0.2  # seconds between two looks
LEAST = '1G'  # that must be free, unless it is said
UNITS = {'': 1, 'k': 2**10, 'M': 2**20, 'G': 2**30}  # as rosbag reads them


class Space:
    """Free bytes that must be left where a bag is, as rosbag takes them: 500M, say."""

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
    """Came: signals, which ask for the end. Exit status: 0 the bag is there, 1 it is not, or not to
    its end."""
    if came:
        return 0
    command = [program, f'--output-name={path}', f'--min-space={space.text}', *words]
    process = subprocess.Popen(['setpriv', '--pdeathsig', 'INT', *command])
    is_short = _wait(process, space, came)
    return _say(path, is_short, process.returncode)


def _wait(process, space, came):
    """For its end, which it is asked for at each signal; true if there is no room for more."""
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
    """What there is now; the exit status."""
    files = bags.in_the_way(path)
    parts = [file for file in files if not file.endswith(bags.WRITTEN)]
    count = sum(map(messages, parts))
    if not count:
        rospy.logfatal('nothing was recorded: %s', _emptiness(path, files))
        return 1
    is_whole = status == 0 and not is_short
    what = path if parts == [path] else f'{parts[0]} to {parts[-1]}'
    how = 'messages' if is_whole else 'messages, not to the end'
    say = rospy.loginfo if is_whole else rospy.logerr
    say('the bag is %s: %d %s; hdlyap plot draws its figures', what, count, how)
    return 0 if is_whole else 1


def _emptiness(path, files):
    if not files:
        return f'there is no {path}'
    cut = ', which was cut short' if files[-1].endswith(bags.WRITTEN) else ''
    return f'no message can be read in {files[-1]}{cut}'


def messages(path):
    """How many there are of ours."""
    try:
        with rosbag.Bag(path, skip_index=True) as bag:
            found = bag.get_type_and_topic_info().topics.values()
    except (rosbag.ROSBagException, OSError):
        return 0
    return sum(topic.message_count for topic in found if topic.msg_type.startswith('hdlyap/'))
