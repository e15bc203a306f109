"""The paper measured again: bags of its runs -> rows of claims.yaml, figures, tables."""
