"""What claims.yaml names: measures, bags -> rows, and pictures, bags -> a figure."""
