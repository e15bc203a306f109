"""Shows what a running hdlyap_node does: on a terminal (watch -> panels -> layout -> screen) or in
one line (line)."""
