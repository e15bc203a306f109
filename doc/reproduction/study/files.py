"""Files that are whole or not there."""

import csv
import io
import os


def write(path, text):
    """A good older one is replaced in one step."""
    unfinished = path + '.new'
    with open(unfinished, 'w') as file:
        file.write(text)
    os.replace(unfinished, path)


def write_csv(path, header, lines):
    text = io.StringIO()
    csv.writer(text, lineterminator='\n').writerows([header, *lines])
    write(path, text.getvalue())
