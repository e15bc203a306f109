"""Shows what a running hdlyap_node does: watch -> line, news; its figures: gathered -> live."""
