"""Files that are whole or not there: a good older one is replaced in one step."""

import csv
import io
import os
import uuid


def write(path, text):
    unfinished = f'{path}.{uuid.uuid4().hex}.new'  # other computers may write it too
    try:
        with open(unfinished, 'w') as file:
            file.write(text)
        os.replace(unfinished, path)
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


def write_csv(path, header, lines):
    text = io.StringIO()
    csv.writer(text, lineterminator='\n').writerows([header, *lines])
    write(path, text.getvalue())


def read(path):
    """Its text; None if there is none."""
    try:
        with open(path) as file:
            return file.read()
    except (OSError, UnicodeDecodeError):
        return None
