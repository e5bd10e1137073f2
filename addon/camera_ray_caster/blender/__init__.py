"""The only folder that imports bpy: Blender's data in, Blender's pictures and panels out."""
