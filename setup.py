"""The Python packages, for catkin_python_setup(); nothing to be run by hand."""

from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

WHERE = 'hdlyap_ros/python'
setup(**generate_distutils_setup(packages=find_packages(WHERE), package_dir={'': WHERE}))
