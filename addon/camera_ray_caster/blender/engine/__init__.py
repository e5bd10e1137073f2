"""The render engine, and the job from an evaluated scene to images and a report."""
