"""One file for each part of claims.yaml: what it measures, rows of it; its figures and tables."""
