"""What tests of unittest need where pytest is as old as 6.0 of Debian 11."""

import unittest

import pytest


@pytest.fixture(autouse=True, scope='class')
def class_cleanups(request):
    """Runs those of addClassCleanup, of which pytest knows from 6.2 on."""
    yield
    if request.cls and issubclass(request.cls, unittest.TestCase):
        request.cls.doClassCleanups()
        assert not request.cls.tearDown_exceptions
