"""How much of a recorded vector lies in the fields of its wave vector, by least squares."""

import numpy as np

from hdlyap.data import waves


def columns(info, field, letter):
    """The T, L or P fields of the field's wave vector at its disks, 2N rows: x components, then y
    components."""
    momenta = (np.array(field.px), np.array(field.py)) if letter == 'P' else None
    return _columns(info, field, letter, np.array(field.x), np.array(field.y), momenta)


def _columns(info, wave, letter, x, y, momenta=None):
    found = []
    for bits in waves.modulations(info, wave.nx, wave.ny, transverse=letter == 'T'):
        where = info, wave.nx, wave.ny, bits, x, y
        if letter == 'P':
            a = waves.modulation(*where)
            found.append(np.concatenate([a * p for p in momenta]))
        else:
            along_x, along_y = waves.gradient(*where)
            found.append(
                np.concatenate([along_y, -along_x] if letter == 'T' else [along_x, along_y])
            )
    return np.array(found).reshape(-1, 2 * x.size).T


def _fit(info, field, letters):
    """The dq half, its norm being 1, = basis @ coefficients + the rest."""
    dq = np.concatenate([field.dqx, field.dqy])
    basis = np.hstack([columns(info, field, letter) for letter in letters])
    return basis, np.linalg.lstsq(basis, dq / np.linalg.norm(dq), rcond=None)[0]


def weight(info, field, letters):
    """Squared norm of what lies in the fields of these letters, 0 .. 1."""
    basis, coefficients = _fit(info, field, letters)
    return float(np.sum((basis @ coefficients) ** 2))


def continued(info, field, letter, x, y):
    """What lies in the T or L fields, at other places than the disks: x and y components in the
    shape of x."""
    _, coefficients = _fit(info, field, letter)
    values = _columns(info, field, letter, x.ravel(), y.ravel()) @ coefficients
    return values.reshape(2, *x.shape)


def chance(info, field, letters):
    """The mean weight of a vector that knows nothing of them."""
    return sum(columns(info, field, letter).shape[1] for letter in letters) / (2 * len(field.x))
