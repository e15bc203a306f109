"""The topic ~state of a run -> positions and momenta of particles, one message at a time."""

import numpy as np

from . import reader, space


class Disks:
    """Positions and momenta of a run. `times` are those of the messages; a method takes the message
    nearest to a time. Iterates over (time, positions, momenta), arrays of N rows with x, y and, in
    space, z; without a box, or with other coordinates than these and an angle, with all of them.
    Particles that rotate have N angles and spins, too; others have none."""

    def __init__(self, run):
        self._run = run
        found = [
            (packed.sim_time, packed.path, packed.recorded, packed.run_id)
            for packed in run.packed((reader.STATE,))
        ]
        self.times = np.array([time for time, *_ in found])
        self._places = [place for _, *place in found]

    def __len__(self):
        return len(self.times)

    def __iter__(self):
        for packed in self._run.packed((reader.STATE,)):
            message = packed.message(np)
            yield message.sim_time, self._rows(message, 'q'), self._rows(message, 'p')

    def positions(self, time):
        return self._rows(self._nearest(time), 'q')

    def momenta(self, time):
        return self._rows(self._nearest(time), 'p')

    def angles(self, time):
        return self._nearest(time).angle

    def spins(self, time):
        return self._nearest(time).spin

    def _nearest(self, time):
        number = int(np.argmin(abs(self.times - time)))
        path, recorded, run_id = self._places[number]
        node = self._run.parts[0].node
        return next(
            packed.message(np)
            for packed in reader.messages(path, node, (reader.STATE,), recorded)
            if packed.run_id == run_id and packed.sim_time == self.times[number]
        )

    def _rows(self, message, name):
        if len(message.q):
            return np.reshape(getattr(message, name), (-1, self._run.info.coordinates))
        return np.stack(space.vectors(message, name.replace('q', '')), axis=1)
