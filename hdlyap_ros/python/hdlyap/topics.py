"""The topics of the node. Each message with a header has one, which has its name but for these."""

import re

from hdlyap import msg

OTHERWISE = {'ModeField': 'fields', 'RunStatus': 'status'}
ASIDE = {'slow_vectors'}  # for viewers, not for bags
OF_THE_RUN = {'status', 'cost', 'state'}  # about all of a run; others count from the last reset on
OF_OTHER_TIMES = {*OF_THE_RUN, 'covariant'}  # not at each report of the averaging alone


def _name(message):
    name = message.__name__
    return OTHERWISE.get(name) or re.sub(r'(?<=.)(?=[A-Z])', '_', name).lower()


TYPES = {
    _name(message): message
    for message in vars(msg).values()
    if 'header' in getattr(message, '__slots__', ())
}
RECORDED = {name: message for name, message in TYPES.items() if name not in ASIDE}
# of which the last message has what was averaged
MEASURED = [name for name in RECORDED if name not in {*OF_THE_RUN, 'run_info', 'fields'}]
