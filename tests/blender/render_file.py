"""A render of a .blend in a Blender of its own, to where the file says: python render_file.py -- FILE.blend."""

import sys

import bpy

bpy.ops.wm.open_mainfile(filepath=sys.argv[-1])
bpy.ops.render.render(write_still=True)
