"""Runs of one scene over values of some parameters: grid (values -> runs), points (bags -> means
over their seeds), table, figure, result (what is printed and written)."""
