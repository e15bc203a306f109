"""What every program of ours imports first, and nothing else does: Ctrl-C ends it as in C, until it
has said otherwise. No traceback of whatever is imported just then."""

import signal

from hdlyap import signals

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

__all__ = ['signals']
