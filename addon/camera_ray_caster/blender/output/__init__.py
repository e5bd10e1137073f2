"""What leaves Blender: image datablocks, files, reports."""
