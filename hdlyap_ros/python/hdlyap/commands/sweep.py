"""Runs of one scene with all combinations of values, and a table and a figure of them.

Some run at a time, each recorded in a bag of its own; means are over the seeds. Bags that are
whole are not made again: the same command goes on with a sweep that was interrupted.

hdlyap sweep --densities "0.2 0.4" --seeds "1 2" --folder sweep

Exit status: 0 all runs are there; 1 a run has failed; 2 refused before the first run; 129, 130, 143
ended by a signal."""

import os
import sys

import rospkg

from hdlyap.plots import fits
from hdlyap.runs import bags, work
from hdlyap.runs.scene import Refused
from hdlyap.sweep import grid, result


FAULT = 1
TEXTS = (
    ('scene', 'quick', 'as in run.launch'),
    ('duration', '', 'time units to average over; default: as in the scene'),
    ('observables', '[spectrum, steps, lp_phases]', 'topics in the bags'),
    ('params', '', 'other parameters of all runs, as {warmup: 50}'),
    ('threads', '1', 'of each run; 0: all cores, one run after the other'),
    ('jobs', '', 'runs at a time; default: one for each core'),
    ('folder', 'sweep', 'of bags, table and figure'),
)


def options(parser):
    for swept in grid.SWEPT:
        parser.add_argument(
            '--' + swept.argument, default='', metavar='"A B .."', help=swept.wanted
        )
    for name, default, text in TEXTS:
        parser.add_argument('--' + name, default=default, help=text)
    fits.add_arguments(parser)


def understood(args, launch, cwd):
    """(runs, folder, jobs)"""
    defaults = {name: default for name, default, _ in TEXTS}
    defaults.update({swept.argument: '' for swept in grid.SWEPT})
    given = {name: getattr(args, name) or default for name, default in defaults.items()}
    folder, jobs = given.pop('folder'), given.pop('jobs')
    cores = len(os.sched_getaffinity(0))
    if jobs and not (jobs.isdecimal() and int(jobs) > 0):
        raise Refused(f'jobs = {jobs}: must be 1 or more')
    path = os.path.join(cwd, folder)
    if os.path.exists(path) and not os.path.isdir(path):
        raise Refused(f'folder = {folder}: must be a folder')
    return grid.runs(given, launch, cwd), path, int(jobs or cores)


def missing(runs, folder):
    """Those whose bag is not whole; what is there of it is kept under another name."""
    found = [run for run in runs if not run.is_done(folder)]
    for run in found:
        for line in bags.keep(run.bag(folder)):
            print(f'hdlyap sweep: {line}', flush=True)
    return found


def sweep(runs, folder, jobs, choice):
    """Exit status."""
    os.makedirs(folder, exist_ok=True)
    failed = work.do('sweep', runs, lambda: missing(runs, folder), folder, jobs)
    there = [run.bag(folder) for run in runs if os.path.exists(run.bag(folder))]
    wrong = failed + result.write(there, folder, choice)
    for line in wrong:
        print(f'hdlyap sweep: {line}', file=sys.stderr, flush=True)
    return 1 if wrong else 0


def main(args):
    os.environ.pop('ROS_NAMESPACE', None)  # roslaunch would put the nodes below it
    launch = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
    try:
        runs, folder, jobs = understood(args, launch, os.environ.get('PWD', os.getcwd()))
        status = sweep(runs, folder, jobs, fits.choice(args))
    except SystemExit:
        print('hdlyap sweep: interrupted; the same command goes on with the runs that are missing')
        raise
    except (Refused, bags.InUse) as refused:
        print(f'hdlyap sweep: {" ".join(str(refused).split())}', file=sys.stderr)
        return 2
    except work.WorkError as error:
        print(f'hdlyap sweep: {error}', file=sys.stderr)
        return 1
    return status
