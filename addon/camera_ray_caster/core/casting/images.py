"""The pictures that a cast returns, in arrays of its own or in those of an earlier cast."""

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from .. import memory
from ..arguments import shown
from ..camera.camera import Camera
from ..conventions import BOTTOM
from ..records import InputError, Shapes
from .pass_needs import image_bytes
from .passes import PASSES
from .plan import Plan


class Images(dict[str, np.ndarray]):
    """The passes by name, (rows, columns[, channels]) arrays with row 0 at the bottom, and how they were made."""

    rows = BOTTOM
    camera: Camera
    shapes: Shapes
    plan: Plan
    seconds: dict[str, float]
    rays: int
    """Number of rays that were cast, with their samples."""

    def __repr__(self) -> str:
        passes = ", ".join(f"{name} {np.shape(image)}" for name, image in self.items())
        return f"<{type(self).__name__}: {passes or 'none'}>"

    def __missing__(self, name: object) -> np.ndarray:
        raise KeyError(f"no pass {name!r} was cast: name it in passes=; there are {', '.join(self) or 'none'}")

    def keep(self, passes: tuple[str, ...]) -> None:
        """Remove all but some passes, and put these in their order."""
        kept = {name: self[name] for name in passes}
        self.clear()
        self.update(kept)

    def take(self, images: Mapping[str, np.ndarray]) -> None:
        """Write passes into these arrays, and keep no others."""
        self.keep(tuple(images))
        for name, image in images.items():
            if image is not self[name]:
                self[name][...] = image


def images_for(passes: tuple[str, ...], shape: tuple[int, int], dtype, into: Images | None) -> Images:
    """Return the images that a cast writes: ``into``, or uninitialized ones. Raises InputError for passes that need
    more memory than is available, and as ``check_reusable`` does.
    """
    if into is not None:
        check_reusable(into, passes, shape, dtype)
        return into
    memory.require(image_bytes(shape, passes, dtype), memory.of_pixels("the passes", shape))
    return Images({name: PASSES[name].empty(shape, dtype) for name in passes})


def reusable(images: Images | None, passes: tuple[str, ...], shape: tuple[int, int], dtype) -> Images | None:
    """Return the images if a cast can write passes into them, else None."""
    try:
        check_reusable(images, passes, shape, dtype)
    except InputError:
        return None
    return images


def check_reusable(images: Images | None, passes: tuple[str, ...], shape: tuple[int, int], dtype) -> None:
    """Raise InputError, which names the pass, if a cast cannot write passes into the images of an earlier one."""
    if not isinstance(images, Images):
        raise InputError(f"into is {shown(images)}: it must be the images that an earlier cast returned")
    if images.rows != BOTTOM:
        raise InputError("into has row 0 at the top: give the images of a cast without rows='top'")
    for name in passes:
        image, meant = images.get(name), PASSES[name]
        whole = meant.shape(shape)
        if not isinstance(image, np.ndarray):
            raise InputError(f"into has no pass {name}: cast the same passes into it as before, or without into")
        if image.shape != whole or image.dtype != (meant.dtype or dtype):
            needed = f"{whole} and {np.dtype(meant.dtype or dtype)}"
            raise InputError(
                f"the pass {name} of into has the shape and type {image.shape} and {image.dtype}, and this cast needs "
                f"{needed}: cast without into"
            )
        masked = isinstance(image, np.ma.MaskedArray)
        if masked or not (image.flags.writeable and image.flags.c_contiguous):
            fault = "has a mask" if masked else "is not a writable, C-contiguous array"
            raise InputError(f"the pass {name} of into {fault}: cast without into")
    for first, second in combinations(passes, 2):
        if np.may_share_memory(images[first], images[second]):  # exact for contiguous arrays
            raise InputError(f"the passes {first} and {second} of into share memory: cast without into")
