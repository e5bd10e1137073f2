"""Cameras as shaders: the ray formula of any model, recorded and written in the Open Shading Language."""
