"""From a recorded bag of hdlyap_node to tables and figures: recorded -> report, figures. Public, as
the studies below doc/ use them: dispersion, equation, fits, numbers, paper, phases, recorded,
steps, structure, waves, figures."""
