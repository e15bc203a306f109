"""As test_strangers, with fewer odd fields at a time, and figures drawn to the end."""

# Second tier: tests/run.sh --all

import unittest

from test_strangers import Strangers


def rendered(figure, folder, name):
    figure.set_dpi(72)
    figure.canvas.draw()
    return []


class Fewer(Strangers):
    save = staticmethod(rendered)

    def test_all_that_is_possible(self):
        self.are_answered(rounds=12)


if __name__ == '__main__':
    unittest.main()
