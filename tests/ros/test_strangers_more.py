"""As test_strangers, with fewer odd fields at a time, and figures drawn to the end."""

import pytest

from test_strangers import Strangers

pytestmark = pytest.mark.second_tier


def rendered(figure, folder, name):
    figure.set_dpi(72)
    figure.canvas.draw()
    return []


class Fewer(Strangers):
    save = staticmethod(rendered)

    def test_all_that_is_possible(self):
        self.are_answered(rounds=12)
