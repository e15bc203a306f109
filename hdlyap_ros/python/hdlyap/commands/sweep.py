"""Runs of one scene with all combinations of values, or of a plan; a table and a figure of them.

Several run at a time, each recorded in a separate bag; means are over the seeds. Runs that are done
are not done again: the same command goes on where it was interrupted.

hdlyap sweep --densities "0.2 0.4" --seeds "1 2" --folder sweep
hdlyap sweep --densities "0.2 0.4" --scene mine.yaml --params "{warmup: 50}" --duration 100
hdlyap sweep --plan runs.yaml --folder campaign
hdlyap sweep --package my_package --program chain_node --scene ring.yaml --over "beta 0.5 1 2"

A plan is a YAML file; each run has a base, a scene, and what differs from it:
one: {base: quick, density: 0.5}
two: {base: mine.yaml, density: 0.6, duration: 400.0}

Exit status: 0 all runs are there; 1 a run has failed; 2 refused before the first run; 129, 130, 143
ended by a signal."""

import os
import sys

from hdlyap.data import fits
from hdlyap.data.reader import RecordingError
from hdlyap.runs import arguments, bags, program, recording, work
from hdlyap.runs.scene import Refused
from hdlyap.sweep import grid, plan, result

FAULT = 1
OF_GRID = (
    ('scene', 'quick', 'scene from which all runs differ, as in run.launch'),
    ('duration', '', 'time units to average over; default: as in the scene'),
    ('observables', '', f'topics in the bags; default: {grid.OBSERVED[0]}'),
    ('params', '', 'other parameters of all runs, as "{warmup: 50}" with its quotes'),
    ('threads', '1', 'threads of each run; 0: all cores, one run after the other'),
)


def options(parser):
    for swept in grid.SWEPT:
        more = '; of spheres three' if swept.argument == 'boundaries' else ''
        parser.add_argument(
            '--' + swept.argument, default='', metavar='"A B .."', help=swept.wanted + more
        )
    text = 'values of any other parameter, as of your particles; may be given several times'
    parser.add_argument(
        '--' + grid.OTHER, action='append', default=[], metavar='"NAME A B .."', help=text
    )
    for name, _, text in OF_GRID:
        parser.add_argument('--' + name, default='', help=text)
    program.add_arguments(parser)
    text = 'YAML file of all runs: {name: {base: scene, parameter: value, ..}, ..}'
    parser.add_argument('--plan', metavar='FILE', help=text)
    parser.add_argument('--quick', action='store_true', help='does the quick runs of the plan')
    parser.add_argument('--only', default='', metavar='"NAME .."', help='does only these runs')
    parser.add_argument('--jobs', default='', help='runs at a time; default: one for each core')
    parser.add_argument(
        '--folder', default='', help='folder of bags, table and figure; default: sweep'
    )
    text = f'space of the disk that must stay free; default: {recording.LEAST}'
    parser.add_argument('--min-space', default=recording.LEAST, metavar='SIZE', help=text)
    parser.add_argument(
        '--write',
        action='store_true',
        help='do nothing but write the scene files and print the names of the runs that are not '
        'done, for runs.launch and runs.sbatch',
    )
    fits.add_arguments(parser)


def understood(args, launch, cwd):
    """Checks the arguments. Returns (runs, folder, jobs)."""
    for word in args.assigned:
        if not word.startswith('__'):  # which roslaunch adds
            name, _, value = word.partition(':=')
            raise Refused(f'{name} = {value}: must be given as an option, as --scene shear')
    if args.jobs and not (args.jobs.isdecimal() and int(args.jobs) > 0):
        raise Refused(f'jobs = {args.jobs}: must be 1 or more')
    folder = args.folder or 'sweep'
    path = os.path.join(cwd, folder)
    recording.Space(args.min_space, path)  # raises Refused if it is not a size
    if os.path.exists(path) and not os.path.isdir(path):
        raise Refused(f'folder = {folder}: must be a folder')
    jobs = int(args.jobs or len(os.sched_getaffinity(0)))
    return chosen(runs(args, launch, cwd), args.only), path, jobs


def runs(args, launch, cwd):
    """All runs of the sweep or of the plan."""
    usual = {name: default for name, default, _ in OF_GRID}
    names = [*usual, *(swept.argument for swept in grid.SWEPT), grid.OTHER]
    node = program.chosen(args)
    given = {name: getattr(args, name) for name in names if getattr(args, name)}
    if args.plan:
        for name, value in {**given, 'form': args.form, 'k': args.k}.items():
            if value:
                raise Refused(f'{name} = {value}: must not be given with a plan')
        return plan.runs(os.path.join(cwd, args.plan), args.quick, launch, node)
    if args.quick:
        raise Refused('quick: must be given with --plan, which has the quick runs')
    fits.choice(args)  # refuses what cannot be fitted
    return grid.runs({**usual, **given}, launch, cwd, node)


def chosen(found, only):
    names = only.split()
    for name in sorted(set(names) - {run.name for run in found}):
        raise Refused(f'only = {only}: must be names of the runs, but no run is called {name}')
    return [run for run in found if run.name in names or not names]


def write(found, folder):
    """Writes scene files and prints names of runs that are missing, to be done elsewhere."""
    os.makedirs(folder, exist_ok=True)
    for run in found:
        run.write(folder)
        if run.lacks(folder):
            print(run.name)
    return 0


def warnings(found, folder):
    """Yields a line for each scene, whatever its seed, that is refused, or of which the node warns,
    or whose run ends before its errors are known."""
    told = set()
    for run in found:
        scene, duration = repr({**run.parameters, 'seed': ''}), run.parameters['duration']
        if scene in told or not duration > 0 or not run.lacks(folder):
            continue
        told.add(scene)
        run.write(folder)
        after, said = run.errors_after(folder)
        if said:
            yield f'{run.name}{" will be refused" if after is None else ""}: {said}'
        if after is not None and duration < after:
            yield (
                f'{run.name} will have no errors: they are stated after {after:g} time units of '
                f'averaging, but its duration is {duration:g}; with duration: 0 and a target, as '
                'lambda_max 1%, it goes on until they are known'
            )


def sweep(found, folder, jobs, args):
    """Does the runs, and writes table and figure. Returns the exit status."""
    os.makedirs(folder, exist_ok=True)
    for line in warnings(found, folder):
        print(f'hdlyap sweep: {line}', file=sys.stderr, flush=True)
    wrong = work.do(found, folder, jobs, args.min_space)
    there = [run.bag(folder) for run in found if os.path.exists(run.bag(folder))]
    if args.plan:
        print(f'{len(there)} of {len(found)} runs are in {folder}', flush=True)
        for line in result.write_all(there, folder):  # its runs may have nothing in common
            print(f'not in the table: {line}', flush=True)
    else:
        try:
            wrong += result.write(there, folder, fits.choice(args))
        except RecordingError as error:
            wrong.append(str(error))
    for line in wrong:
        print(f'hdlyap sweep: {line}', file=sys.stderr, flush=True)
    return 1 if wrong else 0


def main(args):
    os.environ.pop('ROS_NAMESPACE', None)  # roslaunch would put the nodes below it
    try:
        launch = arguments.launch_folder()
        found, folder, jobs = understood(args, launch, os.environ.get('PWD', os.getcwd()))
        status = write(found, folder) if args.write else sweep(found, folder, jobs, args)
    except SystemExit:
        print('hdlyap sweep: interrupted; the same command goes on with the runs that are missing')
        raise
    except (Refused, RecordingError, bags.InUse) as refused:
        print(f'hdlyap sweep: {" ".join(str(refused).split())}', file=sys.stderr)
        return 2
    except work.WorkError as error:
        print(f'hdlyap sweep: {error}', file=sys.stderr)
        return 1
    return status
