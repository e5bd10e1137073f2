"""Real lenses: their prescriptions, surfaces, pupils and focus, and the rays traced through them. Lengths are mm.

The lens frame has x to the right, y up and z from the scene to the film, with the first surface's vertex at z = 0.
"""
