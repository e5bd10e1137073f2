"""A user's program with every public name: it runs where there is only numpy, and mypy --strict finds nothing in it."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import camera_ray_caster as crc

TOP = crc.Number("every_top", "Top", "Of the upper edge", 1.4, 0.1, 1.5, "angle")
SIDE = crc.Choice("every_side", "Side", "Which", "A", (crc.Item("A", "A", "first", 0), crc.Item("B", "B", "second", 1)))
ON = crc.Flag("every_on", "On", "Whether", True)


@dataclass(frozen=True)
class Every(crc.Model):
    """A panorama of the user's own."""

    top: float
    side: str
    on: bool
    key, label, group, number = "EVERY_NAME", "Every Name", "Panorama", 1099
    description = "All around"
    SETTINGS = (TOP, SIDE, ON)
    FORMULA = (crc.Step("Angles", "x, y"),)

    def rays(self, x: Any, y: Any) -> Any:
        """See Model."""
        lon, up = (x / self.size[0] - 0.5) * 2 * np.pi, (2 * y / self.size[1] - 1) * self.top
        return (0.0, 0.0, 0.0), (np.sin(lon) * np.cos(up), np.sin(up), -np.cos(lon) * np.cos(up))


def summary(images: crc.Images, fit: crc.Fit, rays: crc.Rays, cloud: crc.PointCloud) -> str:
    """What was made, in a line."""
    depth: NDArray[Any] = images["depth"]
    return f"{crc.__version__} {depth.shape} {fit.worst:.3f} {rays.directions.shape} {len(cloud)}"


def main(folder: Path) -> None:
    """All but Blender's functions."""
    crc.register_model(Every)
    pose = crc.look_at((0, -4, 1), (0, 0, 0))
    camera: crc.Camera = crc.camera("EVERY_NAME", (64, 48), pose)
    lens = crc.camera("OPENCV_FISHEYE", (64, 48), crc.pose_from_opencv(np.eye(4)), fx=30.0, fy=30.0, cx=31.5, cy=23.5)
    shapes: crc.Shapes = crc.join(crc.spheres([(0, 0, 0)], 1.0), crc.planes((0, 0, -1), infinite=True))
    shapes = crc.join(shapes, crc.mesh([(0, 0, 2), (1, 0, 2), (0, 1, 2)], [(0, 1, 2)]))
    scene = crc.Scene(camera, shapes)
    images = crc.cast(scene, passes=("depth", "normal"))
    matrix: NDArray[np.float64] | None = lens.K
    fit = crc.fit(lens, "OPENCV_PINHOLE", within=0.5)
    cloud = crc.scan(scene)
    hits = crc.cast_rays((0, 0, 3), [(0, 0, -1)], shapes, passes=("distance",))
    seen = crc.visible(camera, shapes, [(0, 0, 1)])
    print(summary(images, fit, camera.rays(), cloud), matrix, hits["distance"], crc.Visibility(int(seen[0])))
    print(crc.occluded((0, 0, 3), [(0, 0, -3)], shapes), crc.explain(scene, (32, 24)), list(crc.models()))
    print(crc.top_down(images).K, crc.cast(scene, passes="depth", rows="top")["depth"].shape)
    paths = crc.export(lens, folder / "lens.yml").paths + crc.save_points(cloud, folder / "scan.ply").paths
    again = crc.load_calibration(paths[0], size=(64, 48), model="OPENCV_FISHEYE")
    crc.camera_to_json(lens)
    restored = crc.camera_from_json(crc.export(lens, folder, "json").paths[0])
    assert restored == lens
    assert again.width == 64
    rig = crc.load_rig(crc.export([lens], folder, "colmap").paths[0])
    print(rig, lens.with_pose(pose).with_settings(k1=0.1), camera.project([(0, 0, 0)], rows="top"))
    try:
        crc.camera("nothing", (1, 1))
    except (crc.InputError, crc.Cancelled) as error:
        print(error)


def in_blender(scene: Any) -> crc.Scene:
    """Blender's functions."""
    crc.register()
    print(crc.read_camera(scene), crc.read_shapes(scene), crc.verify(scene))
    crc.unregister()
    return crc.read_scene(scene, passes=("flow_forward",))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
