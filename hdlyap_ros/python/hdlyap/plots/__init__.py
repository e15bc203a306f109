"""From a recorded bag of hdlyap_node to tables and figures: recorded -> report, figures."""
