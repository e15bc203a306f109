"""The velocity of LP modes beside the slope of their branch, and beside the equation of motion of
the fields."""

from math import sqrt

from hdlyap.data import steps
from hdlyap.plots import equation, paper

from . import averages
from .row import Row


def over_slope(quantity, v, error, recording):
    """Row: v / c_L with our slope of the smallest LP step; with that of the paper's fit as a
    remark."""
    own = [step for _, step in steps.resolved_lp(recording.steps)] if recording.steps else []
    if v is None or not own:
        return Row(f'{quantity} / c_L')
    step, fitted = own[0], paper.slope_l(recording.info.density)
    k = step.wave_number
    ratio = averages.quotient((v * k, error * k), (step.exponent, step.std_error))
    remark = f'c_L of {steps.name(step)}; {v / fitted:.3f} with that of the paper\'s fit'
    return Row(f'{quantity} / c_L', None, *ratio, remark=remark)


def of_fields(density):
    """[T13]: Z / sqrt(2), with Henderson's Z = P / (density kT)."""
    return float(equation.compressibility(density)) / sqrt(2)
