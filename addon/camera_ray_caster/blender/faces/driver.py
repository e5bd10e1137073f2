"""Whether Blender can draw: without a window it asks EGL for a context, and ends the process where there is none."""

import ctypes
import sys

import bpy

from ...core.records import InputError

SURFACELESS = 0x31DD
"""EGL_PLATFORM_SURFACELESS_MESA."""
HOW = "install Mesa's software OpenGL (libegl1, libgl1-mesa-dri), or cast with another engine"


def check_driver(engine: str) -> None:
    """Raise InputError if an engine cannot render without a graphics driver: in background on Linux, where
    EGL is missing or has no display.
    """
    if not (bpy.app.background and sys.platform.startswith("linux")):
        return
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError as error:
        raise InputError(f"{engine} renders on a GPU, and this machine has no EGL: {HOW}") from error
    egl.eglGetDisplay.restype = egl.eglGetPlatformDisplay.restype = ctypes.c_void_p
    egl.eglGetDisplay.argtypes = [ctypes.c_void_p]
    egl.eglGetPlatformDisplay.argtypes = [ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p]
    egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
    displays = egl.eglGetPlatformDisplay(SURFACELESS, None, None), egl.eglGetDisplay(None)
    if not any(display and egl.eglInitialize(display, None, None) for display in displays):
        raise InputError(f"{engine} renders on a GPU, and this machine's EGL has no display: {HOW}")
