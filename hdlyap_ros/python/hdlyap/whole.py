"""Writes files so that they are complete or not there."""

import contextlib
import csv
import io
import os
import uuid

BAG = b'#ROSBAG'  # how a bag begins


@contextlib.contextmanager
def written(path):
    """Gives a name beside the path, with the same ending, to write to. At the end that file
    replaces an older one in one step, but only if all went well and it was written. A bag is never
    replaced: that raises OSError."""
    _refuse_bag(path)
    folder, name = os.path.split(path)
    unfinished = os.path.join(folder, f'.{uuid.uuid4().hex}.{name}')  # others may write it, too
    try:
        yield unfinished
        if os.path.exists(unfinished):
            os.replace(unfinished, path)
    except OSError as error:  # a full disk names no file
        if error.filename not in (None, unfinished):
            raise
        raise OSError(error.errno, error.strerror or str(error), path)
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


def _refuse_bag(path):
    if not os.path.isfile(path):
        return
    with open(path, 'rb') as file:
        if file.read(len(BAG)) == BAG:
            raise OSError(f'{path}: must be another file: it is a bag, which is not overwritten')


def write(path, text):
    with written(path) as unfinished, open(unfinished, 'w', encoding='utf-8') as file:
        file.write(text)


def write_csv(path, header, lines):
    text = io.StringIO()
    csv.writer(text, lineterminator='\n').writerows([header, *lines])
    write(path, text.getvalue())
