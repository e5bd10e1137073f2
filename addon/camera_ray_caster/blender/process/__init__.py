"""The process that runs Blender: requests to stop, scripts in files that are not run, its output."""
