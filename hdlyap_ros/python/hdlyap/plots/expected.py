"""Vector of a step of spheres -> its fit, by least squares, with the fields of its set's waves: T,
or L and P."""

import numpy as np

from hdlyap.data import space, steps, waves


class Expected:
    """Displacements of a ModeField, scaled to a mean square of one, and their projection on the
    fields of these steps. `along`: the directions in which their waves have nodes; `weight`: the
    part of the square of dq that is in the projection."""

    def __init__(self, field, found, info):
        self.info, self._field = info, field
        self._waves = [(step.kind, space.nodes(step, info)) for step in found]
        self.q, dq = space.vectors(field), space.displacements(field, info)
        self.dq = dq / np.sqrt(np.mean(np.sum(dq**2, axis=0)))
        self.along = [d for d in range(3) if any(nodes[d] for _, nodes in self._waves)]
        shapes, roots = self._shapes(self.q), space.roots(info)
        table = np.array([*shapes, *self._velocities(roots**2)]) * roots
        table = table.reshape(len(table), -1).T
        found, *_ = np.linalg.lstsq(table, (self.dq * roots).ravel(), rcond=None)
        self._of_shapes = found[: len(shapes)]
        self.projection = (table @ found).reshape(self.dq.shape) / roots
        squares = (np.sum((part * roots) ** 2) for part in (self.projection, self.dq))
        self.weight = float(np.divide(*squares))

    def _bits(self, kind, nodes):
        return waves.modulations(
            self.info, *nodes[:2], transverse=kind == steps.T, nz=sum(nodes[2:])
        )

    def _shapes(self, q):
        shape = {steps.T: waves.transverse, steps.LP: waves.longitudinal}
        return [
            shape[kind](self.info, nodes, bits, q)
            for kind, nodes in self._waves
            for bits in self._bits(kind, nodes)
        ]

    def _velocities(self, masses):
        (x, y, *z), v = self.q, space.vectors(self._field, 'p') / masses
        return [
            v * waves.modulation(self.info, *nodes[:2], bits, x, y, *nodes[2:], *z)
            for kind, nodes in self._waves
            for bits in (self._bits(kind, nodes) if kind == steps.LP else ())
        ]

    def at(self, q):
        """The T or L field of the projection at other positions."""
        return np.tensordot(self._of_shapes, self._shapes(q), axes=1)
