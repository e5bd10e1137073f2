"""OpenImageIO's st_warp, as a program of its own: a process with pip's OpenImageIO is none for Blender's Cycles.

python st_warp.py PICTURE.npy MAP.npy OUTPUT.npy, float32 arrays (rows, columns, channels), the top row first
"""

import sys

import numpy as np
import OpenImageIO as oiio


def buffer(path):
    image = np.load(path)
    made = oiio.ImageBuf(oiio.ImageSpec(image.shape[1], image.shape[0], image.shape[2], "float"))
    made.set_pixels(made.roi, image)
    return made


if __name__ == "__main__":
    picture, st_map, output = sys.argv[1:]
    warped = oiio.ImageBufAlgo.st_warp(buffer(picture), buffer(st_map), "triangle", 0.0, 0, 1, False, True)
    np.save(output, warped.get_pixels(oiio.FLOAT))
