"""The benchmark's contenders: this caster, and the compiled ray tracers that are installed.

Each contender prepares a scene once and returns a function that makes the picture's arrays once. Only this function is
timed; the preparation (a tracer's acceleration structure) is timed separately. All contenders use the same pinhole
camera and the same spheres, except that Embree gets icospheres, since embreex supports triangles only.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

import numpy as np

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import PLANE, SPHERE, BlenderCamera, Shapes

PASSES = ("depth", "normal", "position", "object_index")
LENS, SENSOR = 50.0, 36.0

PAUSE = 0.15
"""Seconds of pause before each timing: the threads of OpenBLAS, for example, keep spinning for a tenth of a second."""


def scene(count: int, width: int, height: int, **raw):
    """Return a camera, and ``count`` equal spheres in front of a wall that fills the picture.

    The total area of the spheres' discs is 0.6 of the picture's area for any ``count``.
    """
    rng = np.random.default_rng(count)
    tangent_x = SENSOR / 2 / LENS
    tangent_y = tangent_x * height / width
    depth = rng.uniform(12, 30, count)
    across, up = rng.uniform(-1, 1, (2, count))
    center = np.stack((across * tangent_x, up * tangent_y, -np.ones(count)), axis=1)
    radius = np.sqrt(0.6 * 4 * tangent_x * tangent_y / np.pi / np.sum(1 / depth**2))
    center = np.vstack((center * depth[:, None], (0, 0, -32)))
    axes = np.vstack((np.broadcast_to(np.eye(3) * radius, (count, 3, 3)), 40 * np.eye(3)[None]))
    index = np.arange(1, count + 2, dtype=np.int32)
    shapes = Shapes(
        kind=np.array([SPHERE] * count + [PLANE], np.uint8), center=center, axes=axes, object_index=index,
        material_index=index, color=np.ones((count + 1, 4), np.float32), name_index=index - 1,
    )  # fmt: skip
    raw = {"type": "PERSP", "lens": LENS, "sensor_width": SENSOR} | raw
    camera = camera_from(
        BlenderCamera("Camera", matrix_world=np.eye(4), resolution_x=width, resolution_y=height, **raw)
    )
    return camera, shapes


def ours(passes, threads: int) -> Callable:
    """Return the contender of this caster: from camera and shapes to finished float32 arrays."""

    def prepare(camera, shapes):
        return lambda: cast(camera, shapes, passes=passes, threads=threads)

    return prepare


AOVS = "d:depth,n:sh_normal,p:position,i:shape_index"
"""Mitsuba's names of PASSES."""


def mitsubas(add: Callable | None = None) -> dict[str, Callable]:
    """Return the contenders of Mitsuba 3, by name; ``add``: see ``mitsuba``."""
    return {
        "Mitsuba 3, aov, 4 passes": mitsuba(AOVS, add),
        "Mitsuba 3, 4 passes in numpy": mitsuba(AOVS, add, copied=True),
        "Mitsuba 3, intersection": mitsuba(None, add),
    }


def mitsuba(aovs: str | None, add: Callable | None = None, copied: bool = False) -> Callable:
    """Return the contender of Mitsuba 3 on its LLVM backend: the aov integrator, or with None only ray intersections.

    Its pictures stay its own arrays, or are ``copied`` to numpy, as this caster's are. The intersections are those of
    coherent rays, as its own integrators ask for those of cameras. ``add(content, shapes)`` adds the shapes to the
    scene's dictionary; by default they are spheres and rectangles.
    """
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")
    import drjit as dr

    def balls(content, shapes):
        for k in range(len(shapes)):
            if shapes.kind[k] == SPHERE:
                content[f"s{k}"] = {
                    "type": "sphere", "center": shapes.center[k].tolist(), "radius": float(shapes.axes[k, 0, 0])
                }  # fmt: skip
            else:
                transform = (
                    mi.ScalarTransform4f().translate(shapes.center[k].tolist()).scale(float(shapes.axes[k, 0, 0]))
                )
                content[f"s{k}"] = {"type": "rectangle", "to_world": transform}

    def prepare(camera, shapes):
        height, width = camera.raster.shape
        content = {
            "type": "scene",
            "sensor": {
                "type": "perspective", "fov": float(np.degrees(2 * np.arctan(SENSOR / 2 / LENS))), "fov_axis": "x",
                "near_clip": 0.1, "far_clip": 1000.0,
                "to_world": mi.ScalarTransform4f().look_at(origin=[0, 0, 0], target=[0, 0, -1], up=[0, 1, 0]),
                "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
                         "component_format": "float32"},
                "sampler": {"type": "independent", "sample_count": 1},
            },
        }  # fmt: skip
        (add or balls)(content, shapes)
        world = mi.load_dict(content)
        if aovs is not None:
            integrator = mi.load_dict({"type": "aov", "aovs": aovs})

            def render():
                image = mi.render(world, integrator=integrator, spp=1)
                if copied:
                    return np.array(image)
                dr.eval(image)
                dr.sync_thread()
                return image

            return render
        rays = camera.rays()
        flat = rays.directions.reshape(-1, 3).T.astype(np.float32)
        ray = mi.Ray3f(mi.Point3f(0, 0, 0), mi.Vector3f(*(mi.Float(np.ascontiguousarray(c)) for c in flat)))
        dr.eval(ray)

        def intersect():
            hit = world.ray_intersect_preliminary(ray, coherent=True)
            dr.eval(hit.t, hit.shape)
            dr.sync_thread()

        return intersect

    return prepare


def embree(camera, shapes):
    """Prepare Embree with embreex: distances of given rays to icospheres of 320 triangles and a quad."""
    import trimesh
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    ball = trimesh.creation.icosphere(subdivisions=2)
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    corners = []
    for k in range(len(shapes)):
        points, faces = (ball.vertices, ball.faces) if shapes.kind[k] == SPHERE else (square, [[0, 1, 2], [0, 2, 3]])
        corners.append((points @ shapes.axes[k].T + shapes.center[k])[np.asarray(faces)])
    world = EmbreeScene()
    TriangleMesh(world, np.concatenate(corners).astype(np.float32))
    rays = camera.rays()
    origins, directions = (vectors.reshape(-1, 3).astype(np.float32) for vectors in (rays.origins, rays.directions))
    world.run(origins[:1], directions[:1], query="DISTANCE")
    return lambda: world.run(origins, directions, query="DISTANCE")


def has(module: str) -> bool:
    """Return whether a module is installed, with the libraries that it needs."""
    try:
        import_module(module)
    except ImportError:
        return False
    return True
