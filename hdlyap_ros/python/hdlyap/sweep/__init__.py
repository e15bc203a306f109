"""Runs that belong together: grid (values -> runs of one scene), plan (file -> named runs), points
(bags -> means over their seeds), table, figure, result (what is printed and written)."""
