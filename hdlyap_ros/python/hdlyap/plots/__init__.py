"""A run, or several seeds (data.said) -> tables and figures: report, figures. equation, paper and
figures are public, because the studies below doc/ use them."""
