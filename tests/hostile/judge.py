"""What may come of a hostile input: a right result, or one line and exit status 2."""

import json

import numpy as np

from ..exr import read_exr

EPS = float(np.finfo(np.float32).eps)


def check_refusal(status, out, errors, folder):
    """A refusal is one line on standard error, and leaves nothing."""
    assert status == 2, f"status {status}: {errors[-3000:]}"
    assert out == "", f"standard output has {out[:300]!r}"
    lines = errors.splitlines()
    assert len(lines) == 1, f"not one line: {errors[-3000:]!r}"
    assert lines[0].isprintable(), f"control characters in {lines[0]!r}"
    left = list(folder.rglob("*"))
    assert not left, f"left behind: {left[:5]}"


def check_cast(status, out, errors, folder):
    """A cast has its files, a report of no disagreement, and pixels as the conventions say."""
    assert status == 0, f"status {status}: {errors[-3000:] or out[:1500]}"
    assert errors == "", f"standard error has {errors[-2000:]!r}"
    reports, layers = list(folder.rglob("report*.json")), list(folder.rglob("*.exr"))
    assert reports
    assert layers
    assert {path.suffix for path in folder.rglob("*") if path.is_file()} == {".json", ".exr", ".png"}
    for path in reports:
        report = json.loads(path.read_text(encoding="utf-8"), parse_constant=_refuse)
        assert report["passed"] is True
        assert report["findings"]
        assert report["passes"]
    for path in layers:
        check_pixels(read_exr(path))


def check_set(status, out, errors, folder):
    """A data set has its arrays, and annotations whose boxes lie in the picture and whose numbers are numbers."""
    assert status == 0, f"status {status}: {errors[-3000:] or out[:1500]}"
    assert errors == "", f"standard error has {errors[-2000:]!r}"
    document = json.loads((folder / "out" / "annotations.json").read_text(encoding="utf-8"), parse_constant=_refuse)
    sizes = {image["id"]: (image["width"], image["height"]) for image in document["images"]}
    assert sizes
    for annotation in document["annotations"]:
        (width, height), (x, y, wide, high) = sizes[annotation["image_id"]], annotation["bbox"]
        assert 0 <= x <= x + wide <= width
        assert 0 <= y <= y + high <= height
    for path in folder.rglob("*_0*.npz"):
        with np.load(path) as images:
            assert images["flow_hidden"].dtype == bool
            assert not np.isnan(images["depth"]).any()


def check_export(status, out, errors, folder):
    """An export has its files; a camera.json makes the rays of the camera in the open file."""
    assert status == 0, f"status {status}: {errors[-3000:] or out[:1500]}"
    assert errors == "", f"standard error has {errors[-2000:]!r}"
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert files
    for path in files:
        if path.name == "camera.json":
            import bpy

            import camera_ray_caster as crc

            document = json.loads(path.read_text(encoding="utf-8"), parse_constant=_refuse)
            names, scene = [camera["name"] for camera in document["cameras"]], bpy.context.scene
            render = scene.render
            views = render.stereo_views if render.views_format == "STEREO_3D" else render.views
            eyes = [view.name for view in views if view.use and render.use_multiview]
            for name, view in zip(names, eyes or [""], strict=True):
                there = crc.read_camera(scene, view=view).rays()
                back = crc.camera_from_json(path, camera=name).rays()
                assert there.directions.tobytes() == back.directions.tobytes(), "other directions come back"
                assert there.origins.tobytes() == back.origins.tobytes(), "other origins come back"
        elif path.suffix in (".txt", ".yml"):
            words = set(path.read_text(encoding="utf-8").lower().replace(",", " ").split())
            assert not words & {"nan", "inf", "-inf"}, f"{path.name} has numbers that are none"


def _refuse(word):
    raise AssertionError(f"the report has {word}")


def check_pixels(channels):
    """Every pass of every layer has values that the conventions allow, and the passes agree with each other."""
    passes: dict[str, dict[str, np.ndarray]] = {}
    for layer, name in {tuple(channel.rsplit(".", 2)[:2]) for channel in channels if channel.count(".") > 1}:
        names = sorted(channel for channel in channels if channel.rpartition(".")[0] == f"{layer}.{name}")
        passes.setdefault(layer, {})[name] = np.stack([channels[channel] for channel in names], axis=-1).astype(float)
    assert passes
    for entries in passes.values():
        for name, check in CHECKS.items():
            if name in entries:
                bad = ~check(entries[name])
                assert not bad.any(), f"{name}: {entries[name][bad][:3]}"
        if {"Valid", "Ray Origin", "Ray Direction", "Distance", "Position"} <= set(entries):
            check_rays(entries)


def check_rays(layer):
    """Where there is a ray its direction is a unit vector, and where it hits the place is on it; elsewhere no hit."""
    valid, distance = layer["Valid"][..., 0] == 1, layer["Distance"]
    lengths = np.linalg.norm(layer["Ray Direction"], axis=-1)
    assert (np.abs(lengths[valid] - 1) <= 4 * EPS).all(), f"directions of length {lengths[valid]}"
    hit = np.isfinite(distance[..., 0]) & (distance[..., 0] < FLOAT32)
    assert not (hit & ~valid).any(), "a hit without a ray"
    position, origin, along = (layer[name][hit] for name in ("Position", "Ray Origin", "Ray Direction"))
    with np.errstate(invalid="ignore", over="ignore"):
        off = np.abs(position - (origin + distance[hit] * along)).max(axis=-1)
        size = np.abs(position).max(axis=-1) + np.abs(origin).max(axis=-1) + distance[hit][..., 0]
    assert (off <= 4 * EPS * size).all(), f"places {off[~(off <= 4 * EPS * size)]} beside their rays"


FLOAT32 = float(np.finfo(np.float32).max)

CHECKS = {
    "Combined": lambda values: ~np.isnan(values),
    "Depth": lambda values: ~np.isnan(values),
    "Distance": lambda values: values >= 0,
    "Distance Bound": lambda values: values >= 0,
    "Position Bound": lambda values: values >= 0,
    "Normal Bound": lambda values: values >= 0,
    "Valid": lambda values: (values == 0) | (values == 1),
    "Shape Index": lambda values: (values >= -1) & (values == np.floor(values)),
    "Ray Origin": lambda values: ~np.isnan(values),
}
"""Which values of a pass are allowed."""
