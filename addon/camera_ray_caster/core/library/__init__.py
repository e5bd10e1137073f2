"""The public interface without Blender: cameras, shapes and files, made from numbers and arrays."""
