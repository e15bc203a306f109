"""Files that are whole or not there: a good older one is replaced in one step."""

import csv
import io

from hdlyap import whole


def write(path, text):
    with whole.written(path) as unfinished, open(unfinished, 'w') as file:
        file.write(text)


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
