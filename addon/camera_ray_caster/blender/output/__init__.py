"""Results: image datablocks, files and reports."""
