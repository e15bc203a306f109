"""Recorded bags -> arrays and frames: reader (the only module that opens a bag), joined (which bags
belong to one run), run (one run), seeds (several runs), summary (either of them as messages),
export (CSV, npz). Nothing here draws. dispersion, factors, fits, phases, steps and waves are
public, too, because the studies below doc/ use them."""
