"""From rays to pictures: the plan, the search for the nearest hits, the passes."""
