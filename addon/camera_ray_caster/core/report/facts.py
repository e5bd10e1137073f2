"""What a camera is, in the words of the lecture and of computer vision: for the report and the panels."""

from __future__ import annotations

from ..camera.camera import Camera


def camera_facts(camera: Camera) -> dict[str, object]:
    """Return names, numbers and lists of numbers, in the order in which they are shown.

    Every camera: its model, eye (world), orthobasis u, v and w = -Z (world, unit), raster (pixels), window (the columns
    x0 .. x1 and rows y0 .. y1 that are rendered), pixel aspect, clip range. Then what the model says of itself
    (``Model.facts``): a pinhole its field of view, d and aspect, an orthographic camera its frame, a general linear one
    its kind; and K, of models that have one. Last the model's settings by name (``Camera.settings``) and its formula,
    step by step.
    """
    raster, basis = camera.raster, camera.pose.basis
    return {
        "name": camera.name,
        "model": camera.model.label,
        "key": camera.model.key,
        "eye": camera.pose.eye.tolist(),
        "u": basis[:, 0].tolist(),
        "v": basis[:, 1].tolist(),
        "w": (0.0 - basis[:, 2]).tolist(),  # no -0
        "raster": [raster.width, raster.height],
        "window": [raster.x0, raster.x1, raster.y0, raster.y1],
        "pixel_aspect": raster.pixel_aspect,
        "clip": [camera.clip_start, camera.clip_end],
        **camera.model.facts(),
        **({} if camera.K is None else {"K": camera.K.tolist()}),
        "settings": dict(camera.settings),
        "formula": [step._asdict() for step in camera.model.FORMULA],
    }
