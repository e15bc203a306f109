"""How a tool that reads bags ends: whatever is wrong with them is one line, and its own exit
status."""

import logging
import os
import sys
import traceback
import warnings

from hdlyap.data.reader import RecordingError, plain


def by(name, main, fault=1):
    """Of the tool of that name. fault: the exit status if something is wrong."""
    logging.getLogger('rosout').addHandler(logging.NullHandler())  # genpy's, of texts that are none
    for kind in (RuntimeWarning, UserWarning):  # numpy's and matplotlib's, of odd numbers
        warnings.simplefilter('ignore', kind)
    try:
        status = main()
    except (RecordingError, OSError) as error:
        status = _say(name, str(error), fault)
    except Exception as error:  # what no check has foreseen: a bag may say anything
        place = traceback.extract_tb(error.__traceback__)[-1]
        where = f'{os.path.basename(place.filename)}, line {place.lineno}'
        what = f'{type(error).__name__}: {error} ({where})'
        status = _say(name, f'what is recorded makes no sense here: {what}', fault)
    sys.exit(status)


def _say(name, text, fault):
    print(f'{name}: {plain(text, 8192)}', file=sys.stderr)
    return fault
