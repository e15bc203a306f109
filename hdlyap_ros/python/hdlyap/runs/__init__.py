"""Many runs, several at a time, which go on where they were interrupted: run (a run), work (does
the runs that are missing), tree and master (processes), bags and recording (bags)."""
