"""Depth of field: the ray that Cycles sends through each pixel belongs to our chief ray, and its lens is ours."""

import numpy as np
import pytest

from camera_ray_caster.blender.cycles import to_cycles
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_surface

ROOM = 6.0
"""Half the side of the box around the camera on which Cycles' rays end."""

PIXELS = 64

WIDE = {
    "panorama_type": "EQUIRECTANGULAR", "latitude_min": -1.3, "latitude_max": 1.2, "longitude_min": -2.5,
    "longitude_max": 2.0,
}  # fmt: skip
PANORAMA = {"type": "PANO", "lens": 50.0}
CASES = {
    "perspective": {},
    "perspective, shifted, tele": {"lens": 135.0, "shift_x": 0.2, "shift_y": -0.1, "aperture_fstop": 0.6},
    "perspective, hexagon": {"aperture_blades": 6, "aperture_rotation": 0.3},
    "perspective, two blades are none": {"aperture_blades": 2, "aperture_rotation": 0.3},
    "perspective, triangle, anamorphic": {"aperture_blades": 3, "aperture_rotation": -0.5, "aperture_ratio": 2.0},
    "perspective, anamorphic": {"aperture_ratio": 0.5},
    "perspective, focus object": {"focus": (1.0, 2.0, -3.0), "aperture_blades": 5},
    "perspective, focus object behind": {"focus": (0.5, -0.5, 2.5)},
    "orthographic": {"type": "ORTHO", "aperture_fstop": 1.0},
    "orthographic, pentagon, anamorphic": {
        "type": "ORTHO", "ortho_scale": 2.0, "aperture_fstop": 1.5, "aperture_blades": 5, "aperture_rotation": 0.2,
        "aperture_ratio": 1.6,
    },
    "equirectangular": PANORAMA | WIDE,
    "equirectangular, square, anamorphic": PANORAMA | WIDE | {
        "aperture_blades": 4, "aperture_rotation": 0.1, "aperture_ratio": 2.0,
    },
    "equidistant": PANORAMA | {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 2.5, "aperture_ratio": 0.5},
    "equidistant, all around": PANORAMA | {
        "panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 6.0, "aperture_blades": 3, "aperture_rotation": 0.7,
    },
    "equisolid": PANORAMA | {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_lens": 15.0, "aperture_blades": 7},
    "polynomial": PANORAMA | {"panorama_type": "FISHEYE_LENS_POLYNOMIAL", "aperture_ratio": 0.5},
    "mirror ball": PANORAMA | {"panorama_type": "MIRRORBALL", "aperture_blades": 3, "aperture_rotation": 0.4},
    "cylinder": PANORAMA | {"panorama_type": "CENTRAL_CYLINDRICAL", "aperture_ratio": 2.0},
    "cube face": PANORAMA | {"panorama_type": "EQUIANGULAR_CUBEMAP_FACE", "aperture_blades": 4},
}  # fmt: skip
OURS = {
    **{name: CASES[name] for name in (
        "perspective, hexagon", "perspective, focus object", "orthographic, pentagon, anamorphic",
        "equirectangular, square, anamorphic", "mirror ball",
    )},
    "omnimax": {"model": "OMNIMAX", "aperture_blades": 6, "aperture_rotation": 0.2},
    "cylinder of another height": {"model": "CYLINDRICAL", "aperture_ratio": 1.5},
    "tilted sensor": {
        "model": "OPENCV_PINHOLE", "calibration_width": 64, "calibration_height": 64, "fx": 89.0, "fy": 89.0,
        "cx": 31.5, "cy": 30.0, "tau_x": 0.03, "tau_y": -0.02, "aperture_blades": 5,
    },
    "camera obscura": {"model": "CAMERA_OBSCURA", "obscura_hole": 0.4, "use_dof": False},
}  # fmt: skip
"""Cameras that are custom ones, with our shader."""


def set_up(bpy, settings):
    """A turned camera within a box."""
    scene, settings = bpy.context.scene, {"aperture_fstop": 0.1, "focus_distance": 2.5, "lens": 50.0} | settings
    bpy.ops.mesh.primitive_cube_add(size=2 * ROOM)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    camera.rotation_euler, camera.location = (0.9, 0.2, 0.7), (0.3, -0.2, 0.1)
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = PIXELS
    data = camera.data
    data.dof.use_dof = True
    if (location := settings.pop("focus", None)) is not None:
        target = bpy.data.objects.new("Target", None)
        scene.collection.objects.link(target)
        target.parent, target.location = camera, location
        data.dof.focus_object = target
    for name, value in settings.items():
        setattr(next(item for item in (data.dof, data, data.camera_ray_caster) if hasattr(item, name)), name, value)
    return scene


def cycles_rays(scene):
    """Cycles' rays: where they end on the box and their directions, (h, w, 3); two renders have the same samples."""
    return cycles_surface(scene, "Position", 2 * ROOM), -cycles_surface(scene, "Incoming", 1.0)


def outline(aperture):
    """Our opening: the points that u and v on a fine grid give, the edge among them."""
    blades = max(aperture.blades, 1)
    u, v = np.meshgrid((np.arange(blades) + 1) / blades - 1e-12, np.linspace(0, 1, 257))
    return np.stack(aperture.points(u.ravel(), v.ravel()), axis=1)


@pytest.mark.parametrize(("case", "custom"), [*((case, False) for case in CASES), *((case, True) for case in OURS)])
def test_rays_pass_through_the_focus_and_fill_the_opening(blender, case, custom, request):
    scene = set_up(blender, (OURS if custom else CASES)[case])
    if custom:
        request.getfixturevalue("osl")
        to_cycles(scene)
    camera = read_camera(scene)
    aperture, basis, eye = camera.aperture, camera.pose.basis, camera.pose.eye
    chief, (end, direction) = camera.rays(), cycles_rays(scene)
    seen = ~np.isnan(end[..., 0])
    assert np.array_equal(seen, chief.valid)
    assert np.count_nonzero(seen) > 0.6 * PIXELS**2  # a dome of the omnimax's film is 0.6006 of it
    # all in the camera's frame from here on
    origins, chief, end, direction = (
        (vectors[seen] - offset) @ basis
        for vectors, offset in ((chief.origins, eye), (chief.directions, 0), (end, eye), (direction, 0))
    )
    sharp = aperture.sharpness((chief / -chief[:, 2:]).T)[:, None] if aperture.tilt else 1 / aperture.focus
    reach = 1 / sharp / -chief[:, 2:] if camera.model.planar else aperture.focus
    focus = origins + reach * chief
    miss = np.linalg.norm(np.cross(end - focus, direction), axis=1)
    # float32: the end within 8 roundings of the box, the direction of the chief ray within 1e-5 where it leaves
    allowed = 8 * EPS32 * 2 * ROOM + 1e-5 * np.linalg.norm(focus - origins, axis=1)
    assert (miss <= allowed).all(), f"{miss.max()} from the point of focus"

    across, upward = (np.broadcast_to(axis, chief.shape) for axis in np.eye(3)[:2])
    normal = np.broadcast_to((0.0, 0.0, -1.0), chief.shape)
    if not camera.model.planar:
        normal = chief
        across, upward = lens_axes(camera, chief)
    along = ((origins - end) * normal).sum(axis=1) / (direction * normal).sum(axis=1)
    opening = end + along[:, None] * direction - origins
    on_lens = np.stack([(opening * axis).sum(axis=1) for axis in (across, upward)], axis=1)
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    sides = np.stack((np.cos(turn), np.sin(turn)))
    ours, theirs = ((points @ sides).max(axis=0) for points in (outline(aperture), on_lens))
    size = np.linalg.norm(outline(aperture), axis=1).max()
    assert (theirs <= ours + allowed.max()).all()
    # a tenth of the way into a corner, or in from the edge of a disc, lies some hundredth of all n rays
    assert (theirs >= ours - 0.1 * size).all()
    evenly = np.stack(aperture.points(*np.random.default_rng(0).random((2, 100000))), axis=1)
    halves, ours_in_half = ((points @ sides > 0).mean(axis=0) for points in (on_lens, evenly))
    assert halves == pytest.approx(ours_in_half, abs=5 * 0.5 / np.sqrt(len(on_lens)))  # deviations of a fair coin


def lens_axes(camera, chief):
    """The axes in which an opening before this chief ray has its width and its height, as our samples have them."""
    size = camera.aperture.radius * 1e-3
    columns = tuple(chief.T)
    eye = tuple(np.zeros_like(c) for c in columns)
    axes = []
    for x, y in ((size, 0.0), (0.0, size)):
        origin, _ = camera.aperture.through(eye, columns, False, x, y)
        axes.append(np.stack(origin, axis=1) / size)
    return axes
