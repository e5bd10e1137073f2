"""A rendered frame as files: a picture, its passes as EXR or NPZ, and the report. They appear whole or not at all."""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from math import ceil
from pathlib import Path
from time import perf_counter
from typing import Any

import bpy
import numpy as np

from ...core.casting.passes import image_bytes
from ...core.memory import of_pixels, require
from ...core.records import Cancelled, InputError
from ...core.report.report import Report, as_json
from ..cycles.picture import Picture
from ..engine.engine import CameraRayCaster
from ..engine.passes import ticked
from ..read.camera import views_of
from ..terminal import signals
from ..terminal.opening import not_run, reported
from . import arrays, file_outputs, reports
from .annotations import ENDING, annotated
from .file_set import appearing
from .stamps import made

PICTURE = {
    "media_type": "IMAGE",
    "file_format": "PNG",
    "views_format": "INDIVIDUAL",
    "color_mode": "RGBA",
    "color_depth": "8",
}
LAYERS = {
    "media_type": "MULTI_LAYER_IMAGE",
    "file_format": "OPEN_EXR_MULTILAYER",
    "views_format": "INDIVIDUAL",  # of several views a file each: what every reader reads
    "color_depth": "32",
    "exr_codec": "ZIP",
    "use_exr_interleave": True,  # one part: what every reader reads, at any pixel aspect
}
"""Image settings by Blender's names, in the order in which they have to be set."""

EXR, NPZ = "EXR", "NPZ"
FORMATS = EXR, NPZ
"""What passes are written as: a multilayer EXR, or NumPy's arrays."""

NOT_WRITTEN = "the compositor's File Output nodes have written nothing: --file-output lets them write where they say"


def render(
    scene,
    folder: Path,
    name: str,
    report_name: str = "report",
    *,
    layers: str = EXR,
    half: bool = False,
    shown: bool = True,
    file_output: bool = False,
    picture: Picture | None = None,
    stamp: Mapping[str, Any] | None = None,
    keypoints: Sequence[str] | None = None,
    beside: Iterable[Path] = (),
) -> tuple[Report, list[Path]]:
    """Render the scene's current frame into ``folder`` and return the report and the files.

    They are NAME.png, NAME.exr (or .npz, as ``layers`` says) and REPORT_NAME.json; of several views NAME_L.png,
    NAME_R.png and so on, by the views' suffixes. ``half`` stores real numbers of passes with 16 bits; without
    ``shown`` there is no NAME.png.
    The compositor's File Output nodes write, where they say, only with ``file_output``.
    ``picture`` takes the place of the combined pass. ``stamp`` stands in the report, with the files and those
    ``beside`` them: see ``stamps``. ``keypoints``: not None for NAME_coco.json, of the first view layer: see
    ``annotations``.
    Leaves all as it was and raises InputError where Blender cannot render or the folder
    cannot be written, Cancelled where it is stopped.
    """
    check(scene)
    keeps = layers == NPZ or keypoints is not None
    with _engine_has(picture, {} if keeps else None) as images, appearing(folder) as temporary:
        report = _composited(scene, file_output)
        report = report if picture is None else report.with_seconds(cycles=picture.seconds)
        started = perf_counter()
        if shown:
            _save(scene, temporary / f"{name}.png", PICTURE)
        if layers == EXR:
            _save(scene, temporary / f"{name}.exr", LAYERS | ({"color_depth": "16"} if half else {}))
        else:
            suffixes = {view.name: view.file_suffix for view in scene.render.views}
            arrays.save(temporary / f"{name}.npz", images, suffixes, half)
        if keypoints is not None:
            shows = f"{name}.png" if shown else f"{name}.{layers.lower()}"
            text = annotated(scene, next(iter(images.values())), shows, keypoints)
            (temporary / f"{name}{ENDING}").write_text(text, encoding="utf-8")
        report = report.with_seconds(files=perf_counter() - started)
        if stamp is not None:
            report = replace(report, made=made(stamp, (*sorted(temporary.iterdir()), *beside)))
        (temporary / f"{report_name}.json").write_text(as_json(report), encoding="utf-8")
        names = sorted(os.listdir(temporary))
        signals.raise_if_stopping()
    return report, [folder / name for name in names]


def check(scene) -> None:
    """Raise InputError for what ``render`` refuses before it begins."""
    _check_layers(scene)
    _check_suffixes(scene.render)
    _check_memory(scene)


@contextmanager
def _engine_has(picture: Picture | None, images: dict | None) -> Iterator[dict | None]:
    """Let our engine show another one's picture, and keep the images that it casts in a dict; yield that."""
    CameraRayCaster.picture, CameraRayCaster.images = picture, images
    try:
        yield images
    finally:
        CameraRayCaster.picture = CameraRayCaster.images = None


def _composited(scene, file_output: bool) -> Report:
    """Render the current frame, let File Output nodes write or not, and return the report."""
    nodes = file_outputs.writing(scene)
    if file_output:
        before = file_outputs.files(scene, nodes)
        report = _rendered(scene)
        written = file_outputs.changed(before, file_outputs.files(scene, nodes))
        return replace(report, file_outputs=written, warnings=not_run())
    with file_outputs.muted(nodes):
        report = _rendered(scene)
    return replace(report, warnings=(*not_run(), *([NOT_WRITTEN] if nodes else [])))


def _rendered(scene) -> Report:
    """Render the current frame and return its report, with Blender's share of the time; Cancelled where it stopped."""
    reports.forget()
    CameraRayCaster.stopped = False
    scene.render.use_sequencer = False  # a strip would be shown in place of the cast
    if hasattr(scene.render, "use_render_cache"):  # before 5.2
        scene.render.use_render_cache = False  # its files lie where the scene's name leads them
    started = perf_counter()
    try:
        with redirect_stdout(None):  # warnings and errors are in the report and in the exception
            bpy.ops.render.render(scene=scene.name)
    except RuntimeError as error:
        raise InputError(reported(error)) from error
    elapsed = perf_counter() - started
    report = reports.latest()
    if CameraRayCaster.stopped:
        raise Cancelled
    if report is None:
        raise RuntimeError("the render failed: what went wrong stands above")
    return report.with_seconds(blender=elapsed - sum(report.seconds.values()))


def _save(scene, path: Path, settings) -> None:
    """Let Blender write the render to a file."""
    signals.raise_if_stopping()
    for name, value in settings.items():
        if hasattr(scene.render.image_settings, name):  # media_type: from 5.0 on; use_exr_interleave: not everywhere
            setattr(scene.render.image_settings, name, value)
    try:
        bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    except RuntimeError as error:
        if not _views_written(scene, path):
            raise OSError(0, str(error).strip()) from error


def _check_layers(scene) -> None:
    """Raise InputError where there is nothing to render."""
    if not any(layer.use for layer in scene.view_layers):
        raise InputError(f"no view layer of scene {scene.name!r} is used for rendering: enable one")


def _check_memory(scene) -> None:
    """Raise InputError where Blender's own copy of the passes takes more memory than there is: it makes that first."""
    render = scene.render
    shape = [side * render.resolution_percentage // 100 for side in (render.resolution_y, render.resolution_x)]
    if render.use_border and render.use_crop_to_border:
        borders = (render.border_min_y, render.border_max_y), (render.border_min_x, render.border_max_x)
        shape = [ceil(side * (high - low)) for side, (low, high) in zip(shape, borders, strict=True)]
    layers = (layer for layer in scene.view_layers if layer.use)
    asked = [entry.key for layer in layers for entry in ticked(scene, layer)]
    require(image_bytes(tuple(shape), asked, np.float32), of_pixels("the passes", tuple(shape)))


def _check_suffixes(render) -> None:
    """Raise InputError where the suffix of a view would put its files elsewhere."""
    for view in render.views if render.use_multiview else ():
        if view.use and any(sign in view.file_suffix for sign in "/\\\0"):
            raise InputError(
                f"the file suffix {view.file_suffix!r} of view {view.name!r} leads to another folder: "
                "take its slashes out (Output properties, Stereoscopy)"
            )


def _views_written(scene, path: Path) -> bool:
    """Return whether each of several views has its file: Blender then misses one without a view's suffix."""
    files = [path.with_stem(path.stem + view.file_suffix) for view in views_of(scene)]
    return bool(files) and all(file.is_file() for file in files)
