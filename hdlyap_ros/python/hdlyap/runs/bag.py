"""The bag of one run, read once."""

from hdlyap.msg import RunStatus
from hdlyap.data import joined, reader
from hdlyap.plots import repetition

# parameters that make no difference to what is measured, or that run_info has as they were resolved
HERE = ('threads', 'wait_for_subscribers', 'checkpoint', 'resume')


class Bag:
    """Also of a run that is not there: then it is not complete."""

    def __init__(self, path):
        self.path = path

    @property
    def info(self):
        """Its run_info, without reading the rest."""
        return list(reader.run_infos(self.path).values())[-1]

    def messages(self, kind):
        """Every message of a type, 'hdlyap/LpPhases' say, of the last run in its order."""
        for packed in joined.one(self.path).packed((kind,)):
            yield packed.message()

    def last(self, kind):
        """The last message of a type; None if there is none."""
        last = None
        try:
            for last in self.messages(kind):
                pass
        except reader.RecordingError:
            return None
        return last

    def is_complete(self):
        """Whether the run went to its end."""
        last = self.last(reader.STATUS)
        return last is not None and last.stage == RunStatus.FINISHED and last.progress >= 1

    def differs_from(self, parameters):
        """In which parameter of the node, in words; '' in none."""
        asked = repetition.parameters(self.info)
        for name, value in parameters.items():
            if name in HERE or name not in asked or _is_chosen(name, value):
                continue
            if not _same(asked[name], value):
                return f'it was run with {name} = {asked[name]}, not {value}'
        return ''


def _is_chosen(name, value):
    """By the node, and in run_info as it was: not known beforehand."""
    return name == 'warmup' and value == 'auto'


def _same(one, other):
    """400 and 400.0 are, as 5 and '5'; lists in their order."""
    if str(one) == str(other):
        return True
    try:
        return float(one) == float(other)
    except (TypeError, ValueError):
        return False
