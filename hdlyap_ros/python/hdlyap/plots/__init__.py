"""From a recorded bag of hdlyap_node to tables and figures: recording -> report, figures."""
