"""As test_strangers, with one odd field at a time."""

# Second tier: tests/run.sh --all

import unittest

from test_data_joined import numbered
from test_strangers import Strangers, cases, damaged, every_kind


def rendered(figure, folder, name):
    figure.set_dpi(72)
    figure.canvas.draw()
    return []


class Alone(Strangers):
    save = staticmethod(rendered)

    def test_every_field(self):
        whole = numbered(every_kind())
        for place, path, _, value in cases():
            odd = damaged(whole[place], path, value)
            with self.subTest(kind=odd._type, path=path, value=repr(value)[:60]):
                if self.is_possible(odd, path, whole[0]):
                    messages = [*whole[:place], odd, *whole[place + 1 :]]
                    self.is_answered(messages, 'plot', '--out', self.out)


if __name__ == '__main__':
    unittest.main()
