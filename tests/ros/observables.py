#!/usr/bin/python3
"""Prints a list of all observables, but for covariant ones, and of what is given."""

import sys

import harness

print('[' + ', '.join([*harness.OBSERVABLES, *sys.argv[1:]]) + ']', end='')
