"""Beside the messages (hdlyap.msg): figures and tables of bags (plots), a terminal screen (follow),
the paper measured again (reproduce)."""
