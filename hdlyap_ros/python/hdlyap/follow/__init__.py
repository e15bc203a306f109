"""A running hdlyap_node -> what it does, on a terminal: watch -> panels -> layout -> screen; or in
one line (line)."""
