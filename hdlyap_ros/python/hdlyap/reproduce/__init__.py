"""The figures and tables of the paper, measured again: what `reproduce` is made of."""
