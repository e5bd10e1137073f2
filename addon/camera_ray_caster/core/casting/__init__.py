"""From rays to pictures: the plan, the search for the nearest hits, and the passes."""
