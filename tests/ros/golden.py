"""The three texts that are compared letter by letter: the table of steps, a screen, what --check
says. HDLYAP_GOLDEN=write puts them there anew, to be looked at."""

import os

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'golden')


def check(case, name, text):
    path = os.path.join(FOLDER, name)
    if os.environ.get('HDLYAP_GOLDEN') == 'write':
        with open(path, 'w') as file:
            file.write(text)
    with open(path) as file:
        case.assertMultiLineEqual(text, file.read())
