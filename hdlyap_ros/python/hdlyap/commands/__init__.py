"""The command hdlyap. Each module here is a subcommand. It has options(parser), main(args), which
returns the exit status, and, if it reads bags, FAULT: the exit status if a bag cannot be used."""

import argparse
import ast
import importlib
import logging
import os
import pkgutil
import signal
import sys
import warnings

from hdlyap import signals
from hdlyap.fault import OURS, described, whose

PROGRAM = 'hdlyap'


def main(words):
    """Does the subcommand that the words name. Returns its exit status."""
    parser = argparse.ArgumentParser(
        prog=PROGRAM,
        usage='%(prog)s COMMAND [ARGUMENT]..',
        description='Starts, follows and repeats runs of hdlyap_node; draws and compares bags.',
        epilog=f'commands:\n{_listed()}\n\n{PROGRAM} COMMAND --help lists its options.',
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument('command', choices=_names(), metavar='COMMAND', help=argparse.SUPPRESS)
    chosen = parser.parse_args(words[:1] or ['--help']).command
    os.environ.pop('MPLBACKEND', None)  # no figure needs it, and it may name no backend
    try:
        module = importlib.import_module(f'{__name__}.{chosen}')
    except ImportError as error:  # if only messages and tools were installed
        sys.exit(f'{PROGRAM} {chosen}: {error}; this command needs all packages of hdlyap')
    except (OSError, ValueError) as error:  # a matplotlibrc that cannot be read
        sys.exit(f'{PROGRAM} {chosen}: cannot start: {error}')
    signals.exit_on_all(but=_rospy_answers)
    return _ended(chosen, module, _parsed(chosen, module, words[1:]))


def _names():
    return sorted(module.name for module in pkgutil.iter_modules(__path__))


def _listed():
    """A line for each subcommand, from its docstring. No module is imported."""
    lines = []
    for name in _names():
        with open(os.path.join(__path__[0], name + '.py'), encoding='utf-8') as file:
            about = ast.get_docstring(ast.parse(file.read()))
        lines.append(f'  {name:<8} {about.splitlines()[0]}')
    return '\n'.join(lines)


def _parsed(name, module, words):
    """The parsed words. Words with :=, for ROS or for a launch file, are in `assigned`."""
    parser = argparse.ArgumentParser(
        prog=f'{PROGRAM} {name}',
        description=module.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    module.options(parser)
    args = parser.parse_args([word for word in words if ':=' not in word])
    args.assigned = [word for word in words if ':=' in word]
    args.error = parser.error
    return args


def _rospy_answers():
    """Whether rospy answers a signal that asks for the end."""
    return 'rospy.core' in sys.modules and sys.modules['rospy.core'].is_initialized()


def _ended(name, module, args):
    """Runs a subcommand. If something is wrong with bags, prints a line and returns FAULT of the
    subcommand."""
    from hdlyap.data.reader import RecordingError, plain

    logging.getLogger('rosout').addHandler(logging.NullHandler())  # genpy warns of damaged texts
    for kind in (RuntimeWarning, UserWarning):  # numpy and matplotlib complain of odd numbers
        warnings.simplefilter('ignore', kind)
    fault = getattr(module, 'FAULT', None)
    try:
        status = module.main(args)
        sys.stdout.flush()
        return status
    except BrokenPipeError:  # the reader, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + signal.SIGPIPE
    except (RecordingError, OSError) as error:
        nobody = whose(error) if isinstance(error, ConnectionError) else None
        text = f'{nobody}: {error}' if nobody else str(error)
    except Exception as error:  # a bag may contain anything that no check has foreseen
        said = whose(error)
        if fault is None and (said is None or isinstance(error, OURS)):
            raise
        said = said or 'unexpected contents in a bag (please report it if the bag is whole)'
        text = f'{said}: {described(error)}'
    print(f'{PROGRAM} {name}: {plain(text, 8192)}', file=sys.stderr)
    return fault or 1
