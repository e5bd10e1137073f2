"""What pictures show, in words for machines that learn: boxes, masks and key points."""
