"""A run, or several seeds (data.summary) -> tables and figures: report, figures. equation, paper
and figures are public, because the studies below doc/ use them."""
