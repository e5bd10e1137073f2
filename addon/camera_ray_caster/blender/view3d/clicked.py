"""The pixels that Step Through shows, and where one of them is dragged."""

from collections.abc import Iterable


class Clicked:
    """The chosen pixels of the active camera's picture."""

    def __init__(self) -> None:
        self.pixels: list[tuple[int, int]] = []
        """(column, row) from the bottom left, the latest last."""
        self.held: list[int] = []
        """Pointer of the region of the 3D View in which the latest pixel is dragged; empty while none is."""

    def choose(self, pixels: Iterable[tuple[int, int]]) -> None:
        """Show these pixels in place of those before."""
        self.pixels = list(pixels)

    def hold(self, regions: Iterable[int]) -> None:
        """Drag the latest pixel in a region, by its pointer, or in none."""
        self.held = list(regions)


clicked = Clicked()
"""Those of the window: operators choose them, and the drawing of views and sidebars shows them."""
