"""What was said of a run, or of several seeds (data.said) -> tables and figures: report, figures.
Public, as the studies below doc/ use them: equation, paper, figures."""
