"""OpenEXR images: their channels are read and written without a library."""
