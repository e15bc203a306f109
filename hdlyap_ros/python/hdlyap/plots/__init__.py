"""From a recorded bag of hdlyap_node to tables and figures: recorded -> report, figures. Public, as
the studies below doc/ use them: equation, paper, phases, recorded, figures."""
