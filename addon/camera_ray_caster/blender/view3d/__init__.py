"""Drawing in the 3D View and in Image Editors."""
