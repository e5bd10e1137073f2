"""Files of other programs, one file each."""
