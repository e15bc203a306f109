"""The Python packages, for catkin_python_setup(); nothing to be run by hand."""

import os
from distutils.core import setup  # setuptools: catkin does not quote the path of its folder

from catkin_pkg.python_setup import generate_distutils_setup

PACKAGES = ['', '.commands', '.data', '.follow', '.plots', '.plots.figures', '.runs', '.sweep']
setup(
    **generate_distutils_setup(
        packages=['hdlyap' + name for name in PACKAGES],
        package_dir={'': 'hdlyap_ros/python'},
        # where distutils is setuptools' own, it writes there what it would write into the sources
        options={'egg_info': {'egg_base': os.environ.get('CATKIN_BINARY_DIR')}},
    )
)
