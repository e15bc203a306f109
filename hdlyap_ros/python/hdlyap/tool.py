"""Every program of this package imports this module first, and nothing else does. It makes Ctrl-C
end the program as in C until the program sets another handler, so that no import shows a
traceback."""

import signal

from hdlyap import signals

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

__all__ = ['signals']
