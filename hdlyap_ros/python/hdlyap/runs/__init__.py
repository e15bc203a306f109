"""Many runs, some at a time, taken up where they were left: run (what one is), work (does those
that are missing), tree and master (processes), display (how far they are), bag and files (what is
left)."""
