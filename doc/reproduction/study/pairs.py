"""The L and P modes that a recorded field of an LP step has beside its vector [T14], each as a
field of its own."""


class Mode:
    """Of one pair: letter, L or P; what else a field has of disks, wave and vector. Its
    displacements are the mode."""

    def __init__(self, field, letter, pair):
        self.letter, self.bits = letter, field.modulation[pair]
        self.kind, self.nx, self.ny = field.kind, field.nx, field.ny
        self.sim_time, self.index, self.exponent = field.sim_time, field.index, field.exponent
        self.x, self.y, self.px, self.py = field.x, field.y, field.px, field.py
        part = slice(pair * len(field.x), (pair + 1) * len(field.x))
        along_x, along_y = (field.l_x, field.l_y) if letter == 'L' else (field.p_x, field.p_y)
        self.dqx, self.dqy = along_x[part], along_y[part]


def modes(field, letter):
    """Of all pairs, in the order of the message; none for other vectors than those of LP steps."""
    return [Mode(field, letter, pair) for pair in range(field.pairs)]
