"""The images of the extension's page."""

from __future__ import annotations

from argparse import RawDescriptionHelpFormatter
from pathlib import Path

import bpy
import numpy as np
from arguments import Parser
from PIL import Image

import camera_ray_caster as crc

ROOT = Path(__file__).resolve().parents[2]

SCENES, FOLDER = ROOT / "blend_scenes", ROOT / "listing"

ICON = "rotunda_fisheye", 256
"""Scene of the icon, and its side in pixels."""
FEATURED = (
    ("rotunda_fisheye", 0, 0, 540, 540),
    ("sculpture_garden", 540, 0, 840, 540),
    ("little_planet", 1380, 0, 540, 540),
    ("living_room_omnimax", 0, 540, 693, 540),
    ("toys_cross_slit", 693, 540, 1227, 540),
)
"""Scene, left, top, width and height of each picture in the featured image."""
SIZE, GROUND = (1920, 1080), (29, 29, 29)
SAMPLES = 6
"""Rays per pixel."""

SCREENSHOTS = {
    "overlay": "sidebar_and_overlay", "step_through": "lesson_03", "gallery": "gallery", "live": "live_look",
    "lens": "lens_in_view",
}  # fmt: skip
"""Names in the folder of screenshots, by name in listing/."""
STILLS, STILL, TURN = 4, 1600, 250
"""Number of frames before the view turns; milliseconds of these frames and the last, and of the other frames."""


def picture(scene: str, width: int, height: int) -> Image.Image:
    """Return the picture of a scene of the gallery, transparent where a pixel has no ray."""
    bpy.ops.wm.open_mainfile(filepath=str(SCENES / f"{scene}.blend"))
    current = bpy.context.scene
    current.render.resolution_x, current.render.resolution_y = width, height
    linear = crc.cast(crc.read_camera(current), crc.read_shapes(current), passes=("combined",), samples=SAMPLES)[
        "combined"
    ]
    straight = linear[..., :3] / np.maximum(linear[..., 3:], np.finfo(np.float32).tiny)
    pixels = np.dstack([encoded(straight), linear[..., 3]]).clip(0, 1)
    return Image.fromarray(np.uint8(255 * pixels[::-1] + 0.5))


def encoded(linear: np.ndarray) -> np.ndarray:
    """Return linear light encoded as sRGB. Source: IEC 61966-2-1."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)


def featured() -> Image.Image:
    """Return the featured image: scenes of the gallery through several cameras, side by side."""
    whole = Image.new("RGB", SIZE, GROUND)
    for scene, left, top, width, height in FEATURED:
        tile = picture(scene, width, height)
        whole.paste(tile, (left, top), tile)
    return whole


def few_colors(images: list[Image.Image]) -> list[Image.Image]:
    """Return screenshots with one common palette, to reduce the file size."""
    width, height = images[0].size
    together = Image.new("RGB", (width, height * len(images)))
    for i, image in enumerate(images):
        together.paste(image, (0, height * i))
    colors = together.quantize(255, Image.Quantize.MAXCOVERAGE, kmeans=2)
    return [image.convert("RGB").quantize(palette=colors, dither=Image.Dither.NONE) for image in images]


def lesson(windows: Path) -> None:
    """Write the animated picture of the Step Through operator from its screenshots."""
    first, *others = few_colors([Image.open(path) for path in sorted(windows.glob("lesson_*.png"))])
    shown = [STILL] * STILLS + [TURN] * (len(others) - STILLS) + [STILL]
    first.save(FOLDER / "step_through.gif", save_all=True, append_images=others, duration=shown, loop=0)


def main(description: str) -> int:
    """Make the images and return 0."""
    parser = Parser(prog="make_listing.py", description=description, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("--windows", type=Path, metavar="FOLDER", help="screenshots of the window's tests: out/gui")
    windows = parser.parse_args().windows
    FOLDER.mkdir(exist_ok=True)
    if windows is None:
        crc.register()  # the scenes' engine
        scene, side = ICON
        picture(scene, side, side).save(FOLDER / "icon.png", optimize=True)
        featured().save(FOLDER / "featured.jpg", quality=88)
        crc.unregister()
        return 0
    for name, taken in SCREENSHOTS.items():
        few_colors([Image.open(windows / f"{taken}.png")])[0].save(FOLDER / f"{name}.png", optimize=True)
    lesson(windows)
    return 0
