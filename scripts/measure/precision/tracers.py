"""Distances found by other ray tracers for the same rays and shapes. Their packages are used for tests only.

A tracer is a function of (case, rays) that returns distances, (n,) float64, with inf for a miss, or None if the case
cannot be set up. A tracer without ellipsoids gets an icosphere of 5120 triangles, and a tracer without infinite planes
a square of 1e6 times the distance.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import INFINITE_PLANE, SPHERE

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float), np.array([[0, 1, 2], [0, 2, 3]])
ENDLESS = 1e6
BOUND = 1e-5
"""Maximum relative change of a camera setting when Blender stores it."""


@dataclass(frozen=True)
class Given:
    """Chief rays through some pixels."""

    pixels: list
    """(row, column) of each pixel in the render window."""
    origins: np.ndarray
    """Origins of the rays, (n, 3)."""
    directions: np.ndarray
    """Unit directions of the rays, (n, 3)."""
    start: np.ndarray
    """Distances of the near clip plane along the rays, (n,); nearer hits do not count."""

    @property
    def begun(self) -> np.ndarray:
        """Points of the rays at ``start``, for tracers without a near clip plane."""
        return self.origins + self.start[:, None] * self.directions


def triangles(shapes, k, origin):
    """Return the vertices and faces of shape k in its own frame, and its axes."""
    import trimesh

    axes = shapes.axes[k]
    if shapes.kind[k] == SPHERE:
        ball = trimesh.creation.icosphere(subdivisions=4)
        return ball.vertices, ball.faces, axes
    if shapes.kind[k] == INFINITE_PLANE:
        reach = ENDLESS * max(np.linalg.norm(shapes.center[k] - origin), 1e-30)
        axes = axes / np.linalg.norm(axes, axis=0) * reach
    return *SQUARE, axes


def meshes(case, rays):
    """Yield the world vertices and the faces of each shape."""
    for k in range(len(case.shapes)):
        points, faces, axes = triangles(case.shapes, k, rays.origins[0])
        yield points @ axes.T + case.shapes.center[k], faces


def ours(case, rays):
    """Return the distances by this caster."""
    distance = cast(case.camera, case.shapes, passes=("distance",), dtype=np.float64)["distance"]
    return np.array([distance[pixel] for pixel in rays.pixels])


def embree(case, rays):
    """Return the distances by Embree 4 with embreex: triangles, float32."""
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    world = EmbreeScene()
    corners = [points[faces] for points, faces in meshes(case, rays)]
    TriangleMesh(world, np.concatenate(corners).astype(np.float32))
    origins, directions = (np.ascontiguousarray(a, np.float32) for a in (rays.begun, rays.directions))
    distances = world.run(origins, directions, query="DISTANCE").astype(np.float64)
    return np.where(distances < 1e36, distances, np.inf) + rays.start


def mitsuba(case, rays):
    """Return the distances by Mitsuba 3, llvm_ad_rgb: exact spheres for round spheres, otherwise triangles, float32."""
    import mitsuba as mi
    import trimesh

    mi.set_variant("llvm_ad_rgb")
    shapes, content = case.shapes, {"type": "scene"}
    with tempfile.TemporaryDirectory() as folder:
        for k, (points, faces) in enumerate(meshes(case, rays)):
            axes = shapes.axes[k]
            if shapes.kind[k] == SPHERE and np.array_equal(axes, axes[0, 0] * np.eye(3)):
                content[f"s{k}"] = {"type": "sphere", "center": shapes.center[k].tolist(), "radius": float(axes[0, 0])}
                continue
            path = str(Path(folder) / f"{k}.ply")
            trimesh.Trimesh(points, faces, process=False).export(path)
            content[f"s{k}"] = {"type": "ply", "filename": path, "face_normals": True}
        world = mi.load_dict(content)
    parts = (mi.Float(np.ascontiguousarray(a, np.float32)) for a in (*rays.begun.T, *rays.directions.T))
    x, y, z, *direction = parts
    hit = world.ray_intersect_preliminary(mi.Ray3f(mi.Point3f(x, y, z), mi.Vector3f(*direction)))
    return np.array(hit.t, np.float64) + rays.start


def ray_cast(case, rays):
    """Return the distances by Blender's scene.ray_cast: triangles, float32."""
    import bpy

    build(case, rays)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    distances = []
    for origin, direction in zip(rays.begun, rays.directions, strict=True):
        hit, position, *_ = bpy.context.scene.ray_cast(depsgraph, origin, direction, distance=1.7e38)
        distances.append(np.linalg.norm(np.array(position, float) - origin) if hit else np.inf)
    return np.array(distances) + rays.start


def cycles(case, rays):
    """Return the distances by Cycles with one sample per pixel: its own camera, triangles, float32."""
    import bpy
    from tests.blender.cycles.cycles import cycles_surface

    build(case, rays)
    if not set_camera(bpy.context.scene, case.raw):
        return None
    reach = 2.0 ** np.ceil(np.log2(max(np.abs(m).max() for m, _ in meshes(case, rays)) + 1e-30))
    images = cycles_surface(bpy.context.scene, "Position", float(min(reach, 1e30)))
    places = np.array([images[pixel] for pixel in rays.pixels])
    distance = np.linalg.norm(places - rays.origins, axis=1)
    return np.where(np.isnan(distance), np.inf, distance)


def build(case, rays) -> None:
    """Make an empty Blender file with a mesh object for each shape, with the shape's matrix."""
    import bpy
    from mathutils import Matrix

    bpy.ops.wm.read_factory_settings(use_empty=True)
    for k in range(len(case.shapes)):
        points, faces, axes = triangles(case.shapes, k, rays.origins[0])
        mesh = bpy.data.meshes.new("Shape")
        mesh.from_pydata(points.tolist(), [], faces.tolist())
        item = bpy.data.objects.new("Shape", mesh)
        bpy.context.scene.collection.objects.link(item)
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = axes, case.shapes.center[k]
        item.matrix_world = Matrix(matrix)  # Blender would read a list of lists by columns
    bpy.context.view_layer.update()


def set_camera(scene, raw) -> bool:
    """Make this camera the scene's camera; return whether Blender stored its settings within BOUND."""
    import bpy
    from mathutils import Matrix

    data = bpy.data.cameras.new("Camera")
    camera = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    wanted = {name: getattr(raw, name) for name in ("lens", "ortho_scale", "shift_x", "shift_y", "sensor_fit")}
    wanted |= {"clip_start": max(raw.clip_start, 1e-6), "clip_end": min(raw.clip_end, 1e30)}
    if raw.model and raw.model not in ("PERSP", "ORTHO"):
        names = data.bl_rna.properties
        wanted |= {"panorama_type": raw.model} | {n: v for n, v in raw.settings.items() if n in names and v is not None}
        data.type = "PANO"
    else:
        data.type = raw.model or raw.type
    for target, values in ((data, wanted), (scene.render, {n: getattr(raw, n) for n in RENDER})):
        for name, value in values.items():
            setattr(target, name, value)
            stored = getattr(target, name)
            if isinstance(value, float) and abs(stored - value) > BOUND * abs(value):
                return False
            if isinstance(value, int) and stored != value:
                return False
    camera.matrix_world = Matrix(np.asarray(raw.matrix_world))
    bpy.context.view_layer.update()
    return bool(np.allclose(np.array(camera.matrix_world), raw.matrix_world, rtol=BOUND, atol=1e-30))


RENDER = (
    "resolution_x", "resolution_y", "pixel_aspect_x", "pixel_aspect_y", "use_border", "border_min_x", "border_max_x",
    "border_min_y", "border_max_y",
)  # fmt: skip
TRACERS = {
    "this caster": ours, "Mitsuba 3 (float32)": mitsuba, "Embree 4 (float32, triangles)": embree,
    "Cycles (float32, triangles)": cycles, "scene.ray_cast (float32, triangles)": ray_cast,
}  # fmt: skip
