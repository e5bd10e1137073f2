"""A rendered frame as files: a picture, its passes as EXR or NPZ, and the report. All files appear, or none."""

import os
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from math import ceil
from pathlib import Path
from time import perf_counter
from typing import Any

import bpy
import numpy as np

from ...core.cast import Images
from ...core.casting.pass_needs import image_bytes
from ...core.conventions import BOTTOM
from ...core.file_set import atomic_folder
from ...core.memory import of_pixels, require
from ...core.names import folded
from ...core.records import Cancelled, InputError
from ...core.report.report import Report, as_json
from ..cycles.renderer import EnginePicture
from ..engine.engine import RenderCall
from ..output import arrays, file_outputs
from ..output.annotations import ENDING, annotated
from ..output.point_files import PointFiles
from ..output.saving import LAYERS, PICTURE, blender_writes, check_whole
from ..output.stamps import made, short
from ..process import signals
from ..process.opening import not_run, refused_as_input
from ..properties.pass_properties import ticked
from ..read.camera_fields import views_of
from ..read.changes import changed
from ..read.frames import check_layers
from ..read.size import size_of

EXR, NPZ = "EXR", "NPZ"
PASS_FORMATS = EXR, NPZ
"""File formats of passes: a multilayer EXR, or NumPy arrays."""

NOT_WRITTEN = "the compositor's File Output nodes were not run: --file-output makes them write their files"


def render(
    scene,
    folder: Path,
    name: str,
    report_name: str = "report",
    *,
    layers: str = EXR,
    half: bool = False,
    rows: str = BOTTOM,
    shown: bool = True,
    file_output: bool = False,
    picture: EnginePicture | None = None,
    stamp: Mapping[str, Any] | None = None,
    keypoints: Sequence[str] | None = None,
    points: PointFiles | None = None,
    beside: Iterable[Path] = (),
    spare: dict[tuple[str, str], Images] | None = None,
    dataset: Mapping[str, Any] | None = None,
) -> tuple[Report, list[Path]]:
    """Make files of the scene's current frame in ``folder``; return the report and the paths of the files.

    The files are NAME.png, NAME.exr (or .npz, depending on ``layers``) and REPORT_NAME.json; with several views,
    NAME_L.png, NAME_R.png and so on, by the views' suffixes. ``half`` stores real numbers of passes with 16 bits,
    ``rows`` is the first row of NPZ files, BOTTOM or TOP, which the report states.
    NAME.png is written only if ``shown``. The compositor's File Output nodes write only with ``file_output``.
    ``picture`` replaces the combined pass. ``stamp`` is stored in the report, with the sizes of the files and of the
    files in ``beside``; see ``stamps``. If ``keypoints`` is not None, NAME_coco.json is written for each view of the
    first view layer; see ``annotations``. With ``points``, the points of that layer are written in their format. The
    passes take the memory of ``spare``, an earlier picture's images by layer and view, and are left there for the next
    one. What ``dataset``, the content of dataset.json, has is left out of report and annotations. Raises InputError if
    Blender cannot render or the folder cannot be written, and Cancelled if stopped; then no files are left behind.
    """
    check(scene)
    if layers == NPZ:
        arrays.entry_names(layer.name for layer in scene.view_layers if layer.use)
    keeps = layers == NPZ or keypoints is not None or points is not None
    call = RenderCall(picture, {} if keeps else None, spare or {})
    with atomic_folder(folder) as temporary:
        report = _composited(scene, call, file_output)
        if picture is not None:
            report = replace(report, warnings=(*report.warnings, *picture.warnings))
            report = report.with_seconds(**{picture.step: picture.seconds})
        started = perf_counter()
        if shown:
            _save(scene, temporary / f"{name}.png", PICTURE)
        suffixes = {view.name: view.file_suffix for view in scene.render.views}
        if layers == EXR:
            _save(scene, temporary / f"{name}.exr", LAYERS | ({"color_depth": "16"} if half else {}))
        else:
            arrays.save(temporary / f"{name}.npz", call.images, suffixes, half, rows)
            if half:
                report = replace(report, accuracy=replace(report.accuracy, stored=float(arrays.HALF.eps) / 2))
        for (layer, view), images in (call.images or {}).items() if keypoints is not None else ():
            if layer == next(iter(call.images))[0]:
                suffix = suffixes.get(view, "")
                stem = name + suffix
                shows, objects = f"{stem}.{'png' if shown else layers.lower()}", dataset and dataset.get("objects")
                text = annotated(scene, images, shows, suffix, keypoints, objects)
                (temporary / f"{stem}{ENDING}").write_text(text, encoding="utf-8")
        if points is not None:
            points.write(temporary / name, next(iter(call.images.values())))
        if keeps and spare is not None:
            spare.update(call.images)
        report = report.with_seconds(files=perf_counter() - started)
        if stamp is not None:
            stamp = stamp if dataset is None else short(stamp)
            files = made(stamp, sorted(temporary.iterdir()), folder, beside)
            report = replace(report, made=files | ({"rows": rows} if layers == NPZ else {}))
        report_text = as_json(report, dataset and dataset.get("common", {}))
        (temporary / f"{report_name}.json").write_text(report_text, encoding="utf-8")
        names = sorted(os.listdir(temporary))
        signals.raise_if_stopping()
    return report, [folder / name for name in names]


def check(scene) -> None:
    """Raise InputError for input that ``render`` refuses before it starts."""
    check_layers(scene)
    _check_suffixes(scene)
    _check_memory(scene)


def _composited(scene, call: RenderCall, file_output: bool) -> Report:
    """Render the current frame, with File Output nodes writing only if ``file_output``, and return the report."""
    nodes = file_outputs.writing(scene)
    if file_output:
        before = file_outputs.files(scene, nodes)
        report = _rendered(scene, call)
        written = file_outputs.changed(before, file_outputs.files(scene, nodes))
        return replace(report, file_outputs=written, warnings=(*report.warnings, *not_run()))
    with file_outputs.muted(nodes):
        report = _rendered(scene, call)
    return replace(report, warnings=(*report.warnings, *not_run(), *([NOT_WRITTEN] if nodes else [])))


def _rendered(scene, call: RenderCall) -> Report:
    """Render the current frame; return its report, with Blender's share of the time. Raises Cancelled if
    it was stopped.

    Beside the picture of another engine, which shows the faces of meshes, meshes are not cast as exact shapes.
    """
    scene.render.use_sequencer = False  # strips would replace the cast picture
    if hasattr(scene.render, "use_render_cache"):  # before 5.2
        scene.render.use_render_cache = False  # cache files are placed by the scene's name
    started = perf_counter()
    with ExitStack() as stack:
        if call.picture is not None:
            changed(stack, scene.camera_ray_caster, exact_shapes=False)
        stack.enter_context(call.handed())
        stack.enter_context(refused_as_input())  # warnings go into the report
        bpy.ops.render.render(scene=scene.name)
    elapsed = perf_counter() - started
    if call.stopped:
        raise Cancelled
    if call.report is None:
        raise RuntimeError("the render failed: see the messages in the terminal")
    return call.report.with_seconds(blender=elapsed - sum(call.report.seconds.values()))


def _save(scene, path: Path, settings) -> None:
    """Let Blender write the render result to a file."""
    signals.raise_if_stopping()
    views = [path.with_stem(path.stem + view.file_suffix) for view in views_of(scene)]
    for name, value in settings.items():
        if hasattr(scene.render.image_settings, name):  # media_type: since 5.0; use_exr_interleave: in some versions
            setattr(scene.render.image_settings, name, value)
    try:
        with blender_writes(path.parent):
            bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    except OSError:
        if not (views and all(file.is_file() for file in views)):  # with several, Blender raises an error all the same
            raise
    if path.suffix == ".png":
        for written in views or [path]:
            check_whole(written)


def _check_memory(scene) -> None:
    """Raise InputError if there is not enough memory for Blender's copy of the passes, which it allocates first."""
    render, shape = scene.render, size_of(scene)[::-1]
    if render.use_border and render.use_crop_to_border:
        borders = (render.border_min_y, render.border_max_y), (render.border_min_x, render.border_max_x)
        shape = tuple(ceil(side * (high - low)) for side, (low, high) in zip(shape, borders, strict=True))
    layers = (layer for layer in scene.view_layers if layer.use)
    asked = [entry.key for layer in layers for entry in ticked(scene, layer)]
    require(image_bytes(shape, asked, np.float32), of_pixels("the passes", shape))


def _check_suffixes(scene) -> None:
    """Raise InputError if a view's file suffix would lead to another folder, or to another view's files."""
    owners: dict[str, str] = {}
    for view in views_of(scene):
        other = owners.setdefault(folded(view.file_suffix), view.name)
        if other != view.name:
            raise InputError(
                f"views {other!r} and {view.name!r} have the same file suffix, {view.file_suffix!r}: change one of "
                "them (Output properties, Stereoscopy)"
            )
        if any(sign in view.file_suffix for sign in "/\\\0"):
            raise InputError(
                f"the file suffix {view.file_suffix!r} of view {view.name!r} leads to another folder: remove its "
                "slashes (Output properties, Stereoscopy)"
            )
