"""Messages of an earlier version -> those of this one, as far as they are known."""

import importlib

UNKNOWN = -1.0  # what numbers are that a bag lacks, as in numbers.stated()


def _class_of(kind):
    package, name = kind.split('/')
    return getattr(importlib.import_module(package + '.msg'), name, None)


def today(kind, md5sum):
    """The class of messages of ours that were recorded with another definition; None of others."""
    cls = _class_of(kind) if kind.startswith('hdlyap/') else None
    return cls if cls is not None and cls._md5sum != md5sum else None


def translated(old, cls):
    """A message of today with what the old one has; real numbers that it lacks are UNKNOWN."""
    new = cls()
    for name, kind in zip(cls.__slots__, cls._slot_types):
        if hasattr(old, name):
            setattr(new, name, _value(getattr(old, name), kind))
        elif kind == 'float64':
            setattr(new, name, UNKNOWN)
    return new


def _value(value, kind):
    if '/' not in kind:
        return value
    cls = _class_of(kind.split('[')[0])
    return [translated(one, cls) for one in value] if '[' in kind else translated(value, cls)
