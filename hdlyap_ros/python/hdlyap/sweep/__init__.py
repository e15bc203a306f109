"""Runs that belong together: grid (values -> runs of one scene), plan (file -> named runs), points
(bags -> means over seeds), table, figure, and result (prints and writes all)."""
