"""A screen without a monitor, and what is on it."""

import os
import subprocess
import tempfile

import matplotlib.image
import numpy as np

SIZE = (1360, 960)


class Screen:
    """Xvfb; env is that of its programs."""

    def __init__(self):
        read, write = os.pipe()
        # without -noreset a picture, its only client, would close it to who comes just then
        self.server = subprocess.Popen(
            ['Xvfb', '-noreset', '-displayfd', str(write), '-screen', '0', '%dx%dx24' % SIZE],
            pass_fds=[write],
            stderr=subprocess.DEVNULL,
        )
        os.close(write)
        with os.fdopen(read) as number:
            self.env = dict(DISPLAY=':' + number.readline().strip(), LIBGL_ALWAYS_SOFTWARE='1')

    def shot(self):
        """Pixels of the screen, [row, column, colour]."""
        with tempfile.NamedTemporaryFile(suffix='.png') as file:
            subprocess.run(
                ['import', '-window', 'root', 'png24:' + file.name],
                check=True,
                env=dict(os.environ, **self.env),
            )
            return np.rint(255 * matplotlib.image.imread(file.name)[:, :, :3]).astype(int)

    def close(self):
        self.server.terminate()
        self.server.wait()
