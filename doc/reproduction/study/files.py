"""Files that are whole or not there, and what stands in them."""

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


def cells(forms, *values):
    """Each value in its form (`g .6g .2g`, `s` for what is text or exact), '' for None."""
    forms = forms.split()
    assert len(forms) == len(values), (forms, values)
    return tuple(
        '' if value is None else value if form == 's' else format(float(value), form)
        for form, value in zip(forms, values)
    )
