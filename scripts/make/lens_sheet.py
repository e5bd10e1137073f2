"""One picture of eight real lenses on the same scene: wide open and stopped down, ours and Cycles'."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

import bpy
from PIL import Image, ImageDraw

import camera_ray_caster as crc

ROOT = Path(__file__).resolve().parents[2]
SCENE, SHEET = ROOT / "blend_scenes" / "real_lens.blend", ROOT / "docs" / "pictures" / "lenses.png"

LENSES = {
    "double_gauss_50mm": 36.0, "petzval_50mm": 36.0, "tessar_100mm": 90.0, "telephoto_127mm": 60.0,
    "retrofocus_22mm": 36.0, "fisheye_170_5mm": 16.0, "fisheye_210_6.3mm": 26.0, "phone_4.2mm": 3.6,
}  # fmt: skip
"""Lens of the library: width of the film in mm."""
SCALE = 10.0
"""Size of lens and film over those of the file: the toys are as large."""
STOPPED = 11.0
WIDTH, HEIGHT, HEAD, SAMPLES = 180, 120, 16, 32
ENGINES = (), ("--engine", "CYCLES", "--samples", str(SAMPLES))


def variant(path: Path, lens: str, film: float, f_stop: float) -> None:
    """Save the scene as it is with a lens."""
    crc.register()  # the lens's properties
    bpy.ops.wm.open_mainfile(filepath=str(SCENE))
    scene, data = bpy.context.scene, bpy.context.scene.camera.data
    data.camera_ray_caster.lens_file = lens
    facts = crc.camera("REAL_LENS", (3, 2), lens_file=lens).model.facts()
    data.lens, data.sensor_width, data.dof.aperture_fstop = SCALE * facts["focal_length"], SCALE * film, f_stop
    scene.camera_ray_caster.samples = SAMPLES
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)


def make_sheet() -> int:
    """Make the picture and return the exit status of the first cast that fails, or 0."""
    sheet = Image.new("RGB", (4 * WIDTH, len(LENSES) * (HEIGHT + HEAD)), "white")
    draw = ImageDraw.Draw(sheet)
    with tempfile.TemporaryDirectory() as folder:
        for row, (lens, film) in enumerate(LENSES.items()):
            widest = crc.camera("REAL_LENS", (3, 2), lens_file=lens).model.facts()["widest_f_number"]
            for column, (f_stop, engine) in enumerate(product((widest, STOPPED), ENGINES)):
                path = Path(folder) / "lens.blend"
                variant(path, lens, film, f_stop)
                words = path, "--passes", "combined", "--output", folder, *engine
                done = subprocess.run((sys.executable, ROOT / "scripts" / "cast.py", *words), stdout=subprocess.DEVNULL)
                if done.returncode:
                    return done.returncode
                left, top = column * WIDTH, row * (HEIGHT + HEAD)
                with Image.open(path.with_suffix(".png")) as picture:
                    sheet.paste(picture.convert("RGB"), (left, top + HEAD))
                name = f"{lens} " if column == 0 else ""
                draw.text((left + 4, top + 2), f"{name}f/{f_stop:.3g}{', Cycles' if engine else ''}", "black")
    SHEET.parent.mkdir(exist_ok=True)
    sheet.quantize(128).save(SHEET, optimize=True)
    return 0
