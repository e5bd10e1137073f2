"""The render engine and its walk from an evaluated scene to images and a report."""
