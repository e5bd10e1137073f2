"""The only folder that imports bpy: it reads Blender's data and makes Blender's images and panels."""
