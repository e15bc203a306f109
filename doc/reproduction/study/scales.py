"""Lengths and velocities of the gas beside those of the modes, by Henderson's equation."""

from hdlyap.plots import equation

HEADER = (
    'density',
    'mean_free_path',
    'k_min',
    'k_max',
    'k_min_times_path',
    'k_max_times_path',
    'v',
    'sound_velocity',
    'sound_over_v',
)


def line(density, v, wave_numbers):
    """wave_numbers: of the steps that were found; v: None if not measured."""
    rate = equation.collision_rate(equation.compressibility(density))
    path, sound = float(equation.mean_free_path(rate)), float(equation.sound_velocity(density))
    ends = (min(wave_numbers), max(wave_numbers)) if wave_numbers else ()
    of_k = [f'{k:.4g}' for k in (*ends, *(k * path for k in ends))] or [''] * 4
    of_v = (f'{v:.4g}', f'{sound:.4g}', f'{sound / v:.4g}') if v else ('', f'{sound:.4g}', '')
    return (f'{density:g}', f'{path:.4g}', *of_k, *of_v)
