"""The extreme cases, each with its reason: one table for the tests, the work-precision run and the comparison.

A case is a Blender camera, shapes as rows (kind, center, axes or radius), and why it is hard. The numbers are exact as
they stand here: what the exact picture is follows from them alone.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE, BlenderCamera, Shapes

from ..cameras.model_examples import ONLY_SOME

TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
SKEW = np.array([[1.0, 0.5, 0.0], [0.0, 1.0, -0.7], [0.3, 0.0, 1.0]])
THIN = np.array([[1.0, 1.0, 0.0], [0.0, 1e-12, 0.0], [0.0, 0.0, 1.0]])
"""Two axes 1e-12 rad apart: a matrix of condition 1e12."""
NARROW = 18e9
"""A lens, mm, whose frame is 2e-9 rad wide."""


def shapes_of(rows):
    """Shapes from rows (kind, center, axes or radius), each named by its number."""
    n = len(rows)
    axes = [np.eye(3) * a if np.ndim(a) == 0 else np.array(a, float) for _, _, a in rows]
    return Shapes(
        kind=np.array([kind for kind, _, _ in rows], np.uint8),
        center=np.array([center for _, center, _ in rows], float).reshape(n, 3),
        axes=np.array(axes, float).reshape(n, 3, 3),
        object_index=np.arange(1, n + 1, dtype=np.int32),
        material_index=np.zeros(n, np.int32),
        color=np.ones((n, 4), np.float32),
        name_index=np.arange(n, dtype=np.int32),
        names=tuple(f"shape {i}" for i in range(n)),
    )


def pose(rotation=None, eye=(0, 0, 0)):
    """A world matrix, (4, 4)."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = np.eye(3) if rotation is None else rotation, eye
    return matrix


@dataclass(frozen=True)
class Case:
    """One extreme case."""

    name: str
    reason: str
    rows: list
    settings: dict = field(default_factory=dict)
    not_held: str = ""
    """Why the caster cannot hold it; empty where it does."""

    @cached_property
    def raw(self):
        """The camera as Blender has it."""
        settings = {"type": "PERSP", "lens": 18.0, "resolution_x": 9, "resolution_y": 9, "matrix_world": pose()}
        settings |= {"clip_start": 1e-9, "clip_end": 1e30} | self.settings
        if settings["type"] not in ("PERSP", "ORTHO"):
            settings["model"] = settings["type"]
        only_some = ONLY_SOME | {name: settings.pop(name) for name in list(settings) if name in ONLY_SOME}
        return BlenderCamera(name="Camera", settings=only_some, **settings)

    @cached_property
    def camera(self):
        """The camera as the caster has it."""
        return camera_from(self.raw)

    @cached_property
    def shapes(self):
        """The shapes."""
        return shapes_of(self.rows)


def around(k=1.0):
    """Shapes on all sides, within 9 k."""
    return [
        (SPHERE, (0, 0, -5 * k), 2 * k), (SPHERE, (4 * k, 1 * k, 3 * k), TURN @ np.diag([2, 1, 0.5]) * k),
        (SPHERE, (-4 * k, -2 * k, 2 * k), SKEW * k), (PLANE, (0, 6 * k, -2 * k), TURN * 3 * k),
        (INFINITE_PLANE, (0, -3 * k, 0), [[1, 0, 0], [0, 0, 1], [0, -1, 0]]),
    ]  # fmt: skip


def ground(radius, height):
    """A planet below a camera that looks level."""
    return [(SPHERE, (0, -(radius + height), 0), radius)]


ALL_AROUND = {"resolution_x": 24, "resolution_y": 24}
LEVEL_SQUARE = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])

SCALE = [
    Case(f"scene of size {k:g}", "sizes and distances far from 1", around(k), {"clip_start": 0.0})
    for k in (1e-12, 1e-6, 1e6, 1e12)
] + [
    Case(f"parallel rays in a scene of size {k:g}", "the same without an eye", around(k),
         {"type": "ORTHO", "ortho_scale": 12 * k, "clip_start": 0.0})
    for k in (1e-12, 1e12)
] + [
    Case(f"float64's own range, {k:g}, {kind}", "squares overflow or vanish",
         [(SPHERE, (0, 0, -5 * k), TURN * 2 * k), (PLANE, (0, 0, -7 * k), TURN * 6 * k)],
         {"clip_start": 0.0, "clip_end": np.inf, "type": kind, "ortho_scale": 6 * k})
    for k in (1e-150, 1e150) for kind in ("PERSP", "ORTHO")
] + [
    Case("a grain across a valley", "radius over distance 1e-12", [(SPHERE, (0, 0, -1e3), 1e-9)], {"lens": 18e12}),
    Case("radius over distance 1e-9", "float32 textbooks lose it at 400, float64 ones at 1e7",
         [(SPHERE, (0, 0, -1e9), 1.0)], {"lens": NARROW}),
    Case("radius over distance 1e-9, turned", "the same with a camera whose axes are rounded",
         [(SPHERE, -1e9 * TURN[:, 2], 0.8)], {"lens": NARROW, "matrix_world": pose(TURN)}),
    Case("size 1e-12 at distance 1e12", "24 decades between them", [(SPHERE, (0, 0, -1e12), 1e-12)], {"lens": 18e24}),
    Case("a world offset of 1e12", "the numbers of the world leave few digits for the scene",
         [(SPHERE, (1e12, 1e12, 1e12 - 5), 2.0)], {"matrix_world": pose(None, (1e12, 1e12, 1e12))}),
    Case("a world offset of 1e7, turned", "the difference comes before the scale",
         [(SPHERE, np.array((1e7, -1e7, 3e6)) - 5 * TURN[:, 2], TURN)], {"matrix_world": pose(TURN, (1e7, -1e7, 3e6))}),
]  # fmt: skip

SURFACE = [
    Case(f"a planet, {height:g} above{seen}", "n^2 - 1 cancels to 4e-7 and below", ground(1e7, height), more)
    for height, seen, more in (
        (2.0, "", {}), (2.0, ", turned", {"matrix_world": pose(TURN)}),
        (2.0, ", at the horizon", {"shift_y": -0.5, "lens": 400.0}), (1e-6, "", {}),
        (2.0, ", by parallel rays", {"type": "ORTHO", "ortho_scale": 8.0}),
        (2.0, ", all around", {"type": "EQUIRECTANGULAR"}),
    )
] + [
    Case("eye inside", "only the far wall counts", [(SPHERE, (0.3, 0.1, 0), 3.0)]),
    Case("eye inside, on an ellipsoid's axis", "far walls at very different distances",
         [(SPHERE, (0, 0, 0), TURN @ np.diag([1e3, 1, 1e-3]))]),
    Case("eye in the center", "there is no direction to the center", [(SPHERE, (0, 0, 0), 3.0)]),
    Case("eye on the surface, looking in", "c = 0 exactly", [(SPHERE, (0, 0, -2), 2.0)]),
    Case("eye on the surface, looking out", "c = 0 exactly, and nothing to see", [(SPHERE, (0, 0, 2), 2.0)]),
    Case("eye 1e-12 inside the wall", "the wall before the clip start must not count",
         [(SPHERE, (0, 0, -1 + 1e-12), 1.0)]),
    Case("eye in a plane", "the plane is seen by no ray but its own", [(INFINITE_PLANE, (0, 0, 0), LEVEL_SQUARE)]),
    Case("clipped open", "the near wall lies before the clip start", [(SPHERE, (0, 0, -5), 2.0)], {"clip_start": 4.0}),
]  # fmt: skip

TANGENT = [
    Case(f"a ray at {1 + off:.12f} radii from the center, {kind}", "the discriminant is 2e-12 of its parts",
         [(SPHERE, (1 + off, 0, -5), 1.0)], {"type": kind, "resolution_x": 1, "resolution_y": 1})
    for kind in ("PERSP", "ORTHO") for off in (-1e-6, -1e-9, -1e-12, 1e-12, 1e-9)
] + [
    Case("a plane met at 1e-9 rad", "D_z keeps 7 digits", [(INFINITE_PLANE, (0, -1e-9, 0), LEVEL_SQUARE)],
         {"lens": NARROW}),
    Case("a plane's end met at 1e-9 rad", "edges are decided without t", [(PLANE, (0, -1, -1e9), LEVEL_SQUARE * 5e8)],
         {"lens": NARROW}),
    Case("a plane turned away by 1e-9 rad", "its offset from the eye cancels",
         [(PLANE, (0, 0, -5), np.array([[0, 1e-9, 1], [1, 0, 0], [0, 1, -1e-9]]))], {"lens": NARROW}),
    Case("coplanar shapes", "equal t: the first counts", [(PLANE, (0, 0, -5), 2.0), (PLANE, (1, 0, -5), 2.0),
         (INFINITE_PLANE, (0, 0, -5), 1.0), (SPHERE, (0, 0, -8), 3.0), (SPHERE, (0, 0, -8), 3.0)]),
]  # fmt: skip

MATRICES = [
    Case("mirrored camera and shapes", "negative scale", [(SPHERE, (0, 1, -5), TURN @ np.diag([-2, 1, 1])),
         (PLANE, (0, 0, -7), TURN @ np.diag([3, -3, 1]))], {"matrix_world": pose(np.diag([-1, 1, 1]))}),
    Case("looking backwards through a negative scale", "the camera's z is turned round", [(SPHERE, (0, 0, 5), 2.0)],
         {"matrix_world": pose(np.diag([1, 1, -1]))}),
    Case("sheared camera and shapes", "axes that are not orthogonal", around(), {"matrix_world": pose(SKEW)}),
    Case("sheared fisheye", "camera lengths are not the world's", around(),
         {"type": "FISHEYE_EQUIDISTANT", "matrix_world": pose(SKEW)}),
    Case("a disc of 1e6 : 1", "its normal keeps its digits", [(SPHERE, (0, 0, -5), TURN @ np.diag([2, 2, 2e-6]))]),
    Case("a disc of 1e6 : 1, edge on", "its silhouette is 1e-6 high", [(SPHERE, (0, 0, -5), np.diag([2, 2e-6, 2]))],
         {"pixel_aspect_x": 1e6, "sensor_fit": "HORIZONTAL"}),
    Case("a needle of 1e6 : 1", "curved by 1e6 across", [(SPHERE, (0, 0, -5), np.diag([2, 2e-6, 2e-6]) @ TURN.T)],
         {"lens": 18e6}),
    Case("a needle of 1e6 : 1, end on", "a normal that turns within 1e-12", [(SPHERE, (0, 0, -5),
         TURN @ np.diag([2e-6, 2e-6, 2]))], {"lens": 18e5, "matrix_world": pose(TURN, (0, 0, -5) + 5 * TURN[:, 2])}),
    Case("axes 1e-12 rad apart", "a matrix of condition 1e12", [(SPHERE, (0, 0, -5), TURN @ THIN)]),
    Case("a plane with axes 1e-12 rad apart", "the same for its edges", [(PLANE, (0, 0, -5), THIN[[2, 0, 1]] * 2)]),
]  # fmt: skip

LENSES = [
    Case(f"lens of {lens:g} mm", "fields of view from nearly 180 degrees to nearly none", around(), {"lens": lens})
    for lens in (1e-6, 1e-3, 1.0, 5000.0, 1e9)
] + [
    Case(f"shift of {shift:g}", "a frame a hundred frames off the axis",
         [(INFINITE_PLANE, (0, 0, -5), 1.0), (SPHERE, (shift * 8, shift * -8, -4), 3.0)],
         {"lens": 50.0, "shift_x": shift, "shift_y": -shift})
    for shift in (-100.0, 100.0)
] + [
    Case(f"pixel aspect {x:g} : {y:g}", "a frame fitted to the other side", around(),
         {"pixel_aspect_x": x, "pixel_aspect_y": y})
    for x, y in ((1.0, 1e-3), (1.0, 1e3))
] + [
    Case("one pixel", "no neighbors", around(), {"resolution_x": 1, "resolution_y": 1}),
    Case("65536 x 1", "one row", around(), {"resolution_x": 65536, "resolution_y": 1}),
    Case("1 x 65536", "one column", around(), {"resolution_x": 1, "resolution_y": 65536}),
]  # fmt: skip

PANORAMAS = [
    Case(f"{kind} all around", "poles, seams and rims", around(), ALL_AROUND | {"type": kind} | more)
    for kind, more in (
        ("EQUIRECTANGULAR", {}), ("EQUIRECTANGULAR", {"shift_x": 0.5, "shift_y": 0.25}), ("CENTRAL_CYLINDRICAL", {}),
        ("CENTRAL_CYLINDRICAL", {"central_cylindrical_radius": 1e-3}), ("EQUIANGULAR_CUBEMAP_FACE", {}),
        ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 6.2}), ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 10 * np.pi}),
        ("FISHEYE_EQUISOLID", {"fisheye_fov": 6.2, "fisheye_lens": 7.0}), ("FISHEYE_LENS_POLYNOMIAL", {}),
        ("FISHEYE_LENS_POLYNOMIAL", {"fisheye_polynomial_k0": 1e-3, "fisheye_polynomial_k3": -1e-5}),
        ("MIRRORBALL", {}),
    )
] + [
    Case("the mirror ball's edge", "the angle runs away from the radius: 1e-4 pixels from the rim",
         [(SPHERE, (0, 0, 5), 4.999)], {"type": "MIRRORBALL", "resolution_x": 4096, "resolution_y": 4096,
         "shift_x": -(0.5 - 0.5 / 4096 - 1e-8), "use_border": True, "border_min_x": 0, "border_max_x": 2 / 4096,
         "border_min_y": 2047 / 4096, "border_max_y": 2050 / 4096}),
]  # fmt: skip

CASES = [*SCALE, *SURFACE, *TANGENT, *MATRICES, *LENSES, *PANORAMAS]

STIFF = {
    "at rest at every frame": (1.0, "whole turns a frame look like rest to whole frames"),
    "thirty times a frame": (30.0, "a picture of one frame sees thirty turns"),
    "an odd number": (97.3, "no common divisor with any even step"),
    "backwards": (-12.5, "half turns look like turns the other way"),
    "hopeless": (1e5, "no budget resolves it: it has to be said"),
}
"""Turns a frame of a bar that the time cameras see, and why that is hard."""
