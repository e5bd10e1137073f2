"""Where the picture ends within the frame: along a few lines, by the rays alone, for any model."""

import numpy as np

AROUND = np.array([(0, 0), (0.5, 0), (1, 0), (0, 0.5), (1, 0.5), (0, 1), (0.5, 1), (1, 1)])
"""Ends of the lines: corners and middles of the sides, as fractions of the frame."""

LINE_PARTS, REFINEMENTS = 32, 5
"""Parts of a line among which the end of the picture is looked for, and how often: 32**-5 is 3e-8."""


def outline_of(model) -> np.ndarray:
    """Return the pixel coordinates of a place in the picture, and of those at which lines from there to the corners of
    the frame and to the middles of its sides leave the picture or the frame, (9, 2).

    The place is the frame's middle, or if it has no ray, the place in the frame nearest to the image of the viewing
    direction. All are the same place if that has no ray, either.
    """
    size = np.array(model.size)

    def has_ray(places):
        x, y = np.moveaxis(places, -1, 0)
        return np.broadcast_to(~np.isnan(model.rays(x, y)[1][0]), x.shape)

    with np.errstate(all="ignore"):
        start = size / 2
        if not has_ray(start[None]):
            ahead = np.clip(model.project(np.array([[0.0, 0.0, -1.0]]))[0], 0, size)
            start = np.where(np.isnan(ahead), start, ahead)
        way, parts = AROUND * size - start, np.arange(LINE_PARTS + 1)[:, None] / LINE_PARTS
        end, length = np.zeros(len(way)), np.ones(len(way))
        for _ in range(REFINEMENTS):
            seen = np.logical_and.accumulate(has_ray(start + (end + length * parts)[..., None] * way))
            last = np.maximum(seen.sum(axis=0) - 1, 0)
            end = end + length * last / LINE_PARTS
            length = np.where(last == LINE_PARTS, 0.0, length / LINE_PARTS)
            if not length.any():
                break
    return np.concatenate((start[None], start + end[:, None] * way))
