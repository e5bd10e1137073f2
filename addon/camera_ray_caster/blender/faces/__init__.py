"""EEVEE's and Workbench's pictures through any central model, of faces that Blender renders."""
