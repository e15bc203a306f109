"""Recorded bags -> arrays and frames: reader (the one place that opens a bag), joined (which bags
belong to one run), run (what load gives of one run), seeds (of several), said (either as messages),
export (CSV, npz). Knows no figure. Public beside it, as the studies below doc/ use them:
dispersion, factors, fits, phases, steps, waves."""
