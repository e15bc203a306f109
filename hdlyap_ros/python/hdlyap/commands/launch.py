"""A run, as roslaunch hdlyap run.launch starts it, after a check of its arguments.

hdlyap launch
hdlyap launch scene:=mine.yaml number:=200 params:="{warmup: 80}" record:=true bag:=mine.bag

It takes the arguments of run.launch. roslaunch ignores an argument that it does not know; here it
is refused.

Exit status: 2 refused; else that of roslaunch."""

import os
import sys

import rospkg

from hdlyap.runs import arguments
from hdlyap.runs.scene import Refused


def options(parser):
    parser.usage = '%(prog)s [ARGUMENT:=VALUE]..'


def main(args):
    launch = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
    try:
        arguments.check(args.assigned, launch, os.environ.get('PWD', os.getcwd()))
    except Refused as refused:
        print(f'hdlyap launch: {refused}', file=sys.stderr)
        return 2
    os.execvp('roslaunch', ['roslaunch', 'hdlyap', 'run.launch', *args.assigned])
