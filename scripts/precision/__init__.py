"""Error against run time: the methods of the work-precision run, and how they are shown. Each gives ``Point``s."""
