"""Cameras as shaders: the rays of any model, recorded and written in the Open Shading Language."""
