"""One file for each part of the paper, in its order. A part is a module with
  TITLE            a line
  runs(plan)       names of the runs that it needs, of those in plan
  claims(bags)     row.Claim of each statement, with the row.Row it is judged by; bags: {name:
                   bag.Bag} of its runs
  figures(bags)    (name, matplotlib figure)
  tables(bags)     (name, header, lines) of CSV files: the numbers behind the figures"""

from . import (
    aspect,
    boxes,
    coordinates,
    densities,
    dispersion,
    fields,
    fluctuations,
    gas,
    hydro,
    intervals,
    localization,
    multiplicities,
    p_mode,
    phases,
    smallest,
    spectrum,
    structure,
    travelling,
    turning,
)

PARTS = (
    spectrum,
    dispersion,
    coordinates,
    fields,
    p_mode,
    turning,
    phases,
    densities,
    smallest,
    aspect,
    multiplicities,
    hydro,
    travelling,
    intervals,
    structure,
    localization,
    gas,
    boxes,
    fluctuations,
)


def chosen(numbers):
    """[(number, part)] in their order; all without numbers."""
    return [
        (number, part)
        for number, part in enumerate(PARTS, start=1)
        if not numbers or number in numbers
    ]


def runs_of(chosen_parts, plan):
    """Names of the runs that these need, each once, in the order of the plan."""
    wanted = {name for _, part in chosen_parts for name in part.runs(plan)}
    return [name for name in plan if name in wanted]
