"""The library's door: cameras, shapes and files made from numbers and arrays, where no Blender is."""
