"""What launch files cannot do by themselves: arguments -> parameters (arguments); bags that are
never overwritten (bags); the steps of a run on the terminal (telling)."""
