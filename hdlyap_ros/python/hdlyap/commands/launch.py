"""A run, as roslaunch hdlyap run.launch starts it, after a check of its arguments.

hdlyap launch
hdlyap launch scene:=mine.yaml number:=200 params:="{warmup: 80}" record:=true bag:=mine.bag

It takes the arguments of run.launch. roslaunch ignores an argument that it does not know; here it
is refused.

Exit status: that of the node, or of its recorder, rviz or window of figures if that ended first;
2, too, if an argument is refused; 1 roslaunch has failed; 129, 130, 143 ended by a signal, after
the node has ended in order."""

import argparse
import os
import sys

import rospkg
import roslaunch
from roslaunch import parent, pmon, rlutil

from hdlyap import signals
from hdlyap.runs import arguments
from hdlyap.runs.scene import Refused


class First(pmon.ProcessListener):
    """Knows how the process ended that ended first."""

    status = None

    def process_died(self, process_name, exit_code):
        if self.status is None:
            self.status = signals.of_shell(exit_code)


def options(parser):
    parser.usage = '%(prog)s [ARGUMENT:=VALUE]..'
    parser.add_argument('others', nargs='*', help=argparse.SUPPRESS)


def main(args):
    try:
        launch = arguments.launch_folder()
        arguments.refuse(args.others)
        arguments.check(args.assigned, launch, os.environ.get('PWD', os.getcwd()))
    except Refused as refused:
        print(f'hdlyap launch: {refused}', file=sys.stderr)
        return 2
    try:
        return launched(os.path.join(launch, 'run.launch'), args.assigned)
    except (roslaunch.RLException, ValueError, rospkg.ResourceNotFound) as error:
        print(f'hdlyap launch: {" ".join(str(error).split())}', file=sys.stderr)
        return 1


def launched(path, words):
    """Does what roslaunch does, whose command tells nobody how its processes have ended."""
    first = First()
    run_id = rlutil.get_or_generate_uuid(None, False)
    roslaunch.configure_logging(run_id)
    rlutil.check_log_disk_usage()
    launch = parent.ROSLaunchParent(run_id, [(path, words)], process_listeners=[first])
    launch.pm = pmon.start_process_monitor()  # before any process: one may end at once
    launch.pm.add_process_listener(first)
    with signals.noticed():
        launch.start()
        launch.spin()
    return first.status or 0
