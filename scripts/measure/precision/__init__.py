"""Error against run time: the methods of the work-precision run, each measured as ``Point``s, and their display."""
