"""Cells of a table -> a tabular of LaTeX, with numbers as math or for the package siunitx."""

import re

STYLES = 'plain', 'siunitx'
NUMBER = re.compile(r'-?\d[\d.]*(?:e[+-]?\d+)?(?:\([\d.]+\))?$')
POINTED, APART = re.compile(r'\((\d+\.\d+)\)'), r' +- \1'  # an error with a point
SYMBOLS = {
    'lambda_max': r'$\lambda_\mathrm{max}$',
    'h_KS': r'$h_\mathrm{KS}$',
    'h_KS/N': r'$h_\mathrm{KS}/N$',
    'v': '$v$',
    'k': '$k$',
    'number': '$N$',
    'density': r'$\rho$',
    'aspect': '$L_y/L_x$',
    'aspect_z': '$L_z/L_x$',
    'compressibility': '$Z$',
    'shear_b': '$b$',
    'exponent_sum': r'$\sum_\ell\lambda_\ell$',
    'kaplan_yorke': 'Kaplan-Yorke dimension',
    'velocity_low': 'velocity, low wall',
    'velocity_high': 'velocity, high wall',
}


class Done(str):
    """A text that is LaTeX already."""


SPECIAL = str.maketrans(
    {
        **{letter: '\\' + letter for letter in '_&%#${}'},
        '\\': r'\textbackslash{}',
        '^': r'\textasciicircum{}',
        '~': r'\textasciitilde{}',
    }
)
MATH = re.compile(r'((?:sigma|epsilon)(?:\^-?\d+)?|\^-?\d+)')  # of a unit


def tabular(head, rows, style, units=()):
    """Lines of a tabular. head: names of columns; units: of each, or none."""
    yield rf'\begin{{tabular}}{{{"l" * len(head)}}}'
    yield r'\hline'
    yield _row(map(symbol, head))
    if any(units):
        yield _row(f'[{unit(one)}]' if one else '' for one in units)
    yield r'\hline'
    for row in rows:
        yield _row(cell(one, style) for one in row)
    yield r'\hline'
    yield r'\end{tabular}'


def _row(cells):
    return ' & '.join(cells).rstrip() + r' \\'


def symbol(name):
    """A name of a quantity as LaTeX; of c_T2 as c_{T,2}. What is LaTeX stays."""
    if isinstance(name, Done):
        return name
    found = re.fullmatch(r'c_([TL])(\d?)', name)
    if found:
        letter, power = found.groups()
        return Done(rf'$c_{{\mathrm{{{letter}}}{"," + power if power else ""}}}$')
    return Done(SYMBOLS.get(name, name.replace('_', ' ').translate(SPECIAL)))


def unit(text):
    """A unit, of a program's own any text, as LaTeX: sigma and epsilon as letters, and powers."""
    parts = MATH.split(text)
    parts[::2] = [part.translate(SPECIAL) for part in parts[::2]]
    parts[1::2] = map(_letter, parts[1::2])
    return Done(''.join(parts))


def _letter(text):
    """sigma^2, or a power without a letter, as math."""
    letter, caret, power = text.partition('^')
    power = f'{{{power}}}' if len(power) > 1 else power
    return ''.join(('$', '\\' * bool(letter), letter, caret, power, '$'))


def cell(text, style):
    """A number as math or as \\num, which takes 12.3(1.5) as 12.3 +- 1.5; another text stays."""
    if isinstance(text, Done):
        return text
    if not NUMBER.match(text):
        return Done(r'--' if text == '-' else text.translate(SPECIAL))
    if style == 'plain':
        return Done(f'${text}$' if 'e' not in text else _power(text))
    return Done(rf'\num{{{POINTED.sub(APART, text)}}}')


def _power(text):
    digits, power = text.split('e')
    return rf'${digits}\times 10^{{{int(power)}}}$'
