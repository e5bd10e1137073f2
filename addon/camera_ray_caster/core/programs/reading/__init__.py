"""Reading files of any program: lenses, poses, and cameras with both."""
