"""The passes of a picture, each computed for a tile of hits. A new pass is one function and one entry in PASSES.

Where a ray hits nothing, depth, distance and footprint are inf, shape_index and face_index are -1, combined is the
world's color, flow_forward and flow_backward are NaN, and all other passes are 0 except those of the ray itself
(ray_origin, ray_direction, valid, solid_angle). A pixel without a ray has the same values, with combined (0, 0, 0, 0),
valid False, and ray_origin, ray_direction and solid_angle 0. A holdout has combined (0, 0, 0, 0) and is a surface in
all other passes; Cycles gives a holdout no depth and no indices.

Of surfaces that coincide, a ray meets the one that is nearer in float64, and of those at the same distance that of the
first row. Cycles shows any of them, by rounding and the order of its own search, which differ from version to version.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors.hit_errors import HitErrors
from ..maths.reused_memory import empty
from ..maths.speed import write_where
from ..maths.vector import matvec, unit
from .flow import NEXT, PREVIOUS, flow_of
from .hit_values import HitValues
from .shading import albedo, shade, sky

ROUNDED_UP = 1 + 2.0**-9
"""Factor that makes up for the rounding of the bounds themselves, to the type in which they are stored."""


AS_IS, SIGNED, COUNTED, RANGE = "as is", "signed", "counted", "range"
"""How a pass is shown as a picture: its numbers themselves, from -1 to 1, one color per number, or scaled."""


@dataclass(frozen=True)
class Pass:
    """All that is declared of a pass. The engine's passes, the check boxes, their order, pictures and files follow."""

    write: Callable[[HitValues, np.ndarray], None]
    """Function that fills ``out``, (rows, columns[, channels]): ``write(values, out)``. If ``missed`` is not None, it
    writes only the pixels that ``values.hits.where`` marks: there may be other shapes in the others.
    """
    text: str
    """Explanation for tooltips, without a period at the end."""
    letters: str = "X"
    """Names of the channels in files: one letter each."""
    dtype: type | None = None
    """Type of the stored numbers; None for the cast's dtype."""
    shown: str = RANGE
    label: str = ""
    """Name in menus and EXR files; "" for the pass's name with capitals."""
    label_before_5_0: str = ""
    """That of Blender before 5.0, for Blender's own passes that have another there."""
    blender: str = ""
    """Name of Blender's own check box in the view layer; "" if the check box is the add-on's."""
    missed: float | Callable[[HitValues, np.ndarray], None] | None = None
    """Of a pass of the surfaces that are hit: the number where nothing is hit, or a function that writes these pixels.
    """
    bounds: tuple[str, ...] = ()
    """Passes whose stored numbers this one bounds the errors of."""
    frames: tuple[str, ...] = ()
    """The other frames that it looks into, NEXT or PREVIOUS."""
    casts: bool = False
    """Whether it casts rays of its own in these frames."""

    @property
    def channels(self) -> int:
        """The length of the last axis; 0 if there is none."""
        return len(self.letters) if len(self.letters) > 1 else 0

    def empty(self, shape: tuple[int, int], dtype) -> np.ndarray:
        """Return an uninitialized array for the pass of a picture, (rows, columns[, channels])."""
        return empty(self.shape(shape), self.dtype or dtype)

    def shape(self, shape: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of the array for the pass of a picture of (rows, columns)."""
        return (*shape, self.channels) if self.channels else shape


def depth(values: HitValues, out):
    """Blender's Z: along the viewing direction for planar cameras, along the ray for all others."""
    out[...] = values.hits.t


def distance(values: HitValues, out):
    """The length of the ray from its origin to the hit."""
    _store(values, np.multiply(values.hits.t, values.length, out=values.array("stored")), out)


def position(values: HitValues, out):
    """The hit point in the world."""
    _store_sum(values, values.point, values.target.pose.eye[:, None, None], out)


def normal(values: HitValues, out):
    """The surface's unit normal in the world, turned towards the ray's origin, without normal and bump maps."""
    _store_sum(values, *values.normal_terms, out)


def uv(values: HitValues, out):
    """The render UV map of the mesh, (u, v, 0); 0 without a map. An exact sphere with a map has u = longitude / 2 pi +
    1/2 and v = latitude / pi + 1/2, and shapes that are made without a mesh have the coordinates of their surface.
    """
    for where, (u, v) in values.uv:
        out[..., 0][where], out[..., 1][where] = u, v
    out[..., 2] = 0


def object_index(values: HitValues, out):
    """Blender's pass index of the object."""
    _store(values, values.look_up(values.target.object_index, "indices"), out)


def material_index(values: HitValues, out):
    """Blender's pass index of the material."""
    _store(values, values.of_material(values.target.material_index, "indices"), out)


def shape_index(values: HitValues, out):
    """The row of the shape in ``Shapes``; each instance has a row of its own."""
    out[...] = values.hits.index


def face_index(values: HitValues, out):
    """The polygon of the evaluated mesh, -1 where no mesh is hit."""
    for where, polygon in values.by_kind(lambda kind, pixels: kind.polygon(values.target.placed, pixels)):
        out[where] = polygon


def valid(values: HitValues, out):
    """Whether the pixel has a ray."""
    out[...] = values.hits.has_ray


def ray_origin(values: HitValues, out):
    """The origin of the chief ray in the world."""
    pose = values.target.pose
    _write_ray(values, matvec(pose.basis, values.hits.rays.origin), pose.eye, out)


def ray_direction(values: HitValues, out):
    """The unit direction of the chief ray in the world."""
    _write_ray(values, unit(values.direction), (0.0, 0.0, 0.0), out)


def solid_angle(values: HitValues, out):
    """The solid angle of the pixel, steradians, to first order: the length of the cross product of the derivatives by x
    and y of the unit direction at its center. 0 for parallel rays. The relative error is at most 64 EPS, plus the
    effect of the pixel's rounding: see ``camera.jacobian``.
    """
    out[...] = values.derivatives.solid_angle
    write_where(out, 0, values.hits.lost)


def footprint(values: HitValues, out):
    """The area of the surface that the pixel covers, in the world, to first order: the pixel's rays, extrapolated from
    its center, on the tangent plane at the hit. The error is that of ``solid_angle``, plus those of the hit's distance
    and normal over the cosine of the angle between ray and normal.
    """
    _store(values, values.derivatives.area_at(values.distance) / values.cosine, out)


def flow_forward(values: HitValues, out):
    """The offset, x and y, of the pixel at which the next frame sees the surface point; NaN for none: see ``flow``."""
    flow_of(values, NEXT).write(out)


def flow_backward(values: HitValues, out):
    """The offset, x and y, of the pixel at which the previous frame sees the surface point; NaN for none."""
    flow_of(values, PREVIOUS).write(out)


def flow_hidden(values: HitValues, out):
    """Whether the surface point is hidden or clipped in the next frame (X), and in the previous frame (Y)."""
    for k, name in enumerate((NEXT, PREVIOUS)):
        flow_of(values, name).write_hidden(out[..., k])


def distance_bound(values: HitValues, out):
    """Upper bound of the errors of the stored distance and of the stored depth; world units."""
    _bound(values, out, lambda errors: (errors.distance, errors.t * errors.rays.length))


def position_bound(values: HitValues, out):
    """Upper bound of the error of the stored position; world units."""
    _bound(values, out, lambda errors: (errors.position, errors.far))


def normal_bound(values: HitValues, out):
    """Upper bound of the error of the stored unit normal."""
    _bound(values, out, lambda errors: (errors.normal, 1.0))


def _bound(values: HitValues, out, of: Callable[[HitErrors], tuple[np.ndarray, Any]]):
    """Write bounds rounded up, plus the error of storing the values; ``of`` returns bounds and sizes of the values."""
    out[...] = 0
    for where, errors in values.errors:
        bound, size = of(errors)
        bound = np.where(size <= np.finfo(out.dtype).max, bound, np.inf)  # larger numbers are stored as infinite
        out[where] = (bound + np.finfo(out.dtype).eps * size) * ROUNDED_UP


def _store(values: HitValues, numbers: np.ndarray, out) -> None:
    """Write numbers where the shapes that are meant are hit."""
    np.copyto(out, numbers, where=values.hits.where, casting="same_kind")


def _store_sum(values: HitValues, vector: np.ndarray, offset: np.ndarray, out) -> None:
    """Write vector plus offset, (3, rows, columns) each, where the shapes that are meant are hit."""
    if values.hits.where is True:  # all at once: threads wait for each other between calls
        np.add(vector, offset, out=out.transpose(2, 0, 1), casting="same_kind")
        return
    total = np.add(vector, offset, out=values.array("stored", 3))
    for axis in range(3):  # all at once takes four to seven times as long
        _store(values, total[axis], out[..., axis])


def _write_ray(values: HitValues, vector, offset, out) -> None:
    """Write vector plus offset, three components each, and 0 for pixels without a ray."""
    for axis, component in enumerate(vector):
        np.add(component, offset[axis], out=out[..., axis], casting="same_kind")
    write_where(out, 0, values.hits.lost)


PASSES = {
    "combined": Pass(shade, "Color of the surface in the light of the scene's lamps", "RGBA", shown=AS_IS,
                     blender="use_pass_combined", missed=sky),
    "albedo": Pass(albedo, "Color of the material without light; of emission, without its strength", "RGB",
                   shown=AS_IS, missed=0),
    "depth": Pass(depth, "Blender's Z: along the viewing direction, or along the ray for panoramas", "Z",
                  blender="use_pass_z"),
    "distance": Pass(distance, "Distance along the ray. The Z pass has the planar depth",
                      missed=np.inf),
    "position": Pass(position, "Hit point in world space", "XYZ", blender="use_pass_position", missed=0),
    "normal": Pass(normal, "Unit normal in world space, turned towards the ray's origin", "XYZ", shown=SIGNED,
                   blender="use_pass_normal", missed=0),
    "uv": Pass(uv, "Coordinates of the render UV map", "UVA", shown=AS_IS, label="UV", blender="use_pass_uv", missed=0),
    "object_index": Pass(object_index, "Pass index of the object", dtype=np.int32, shown=COUNTED,
                         label_before_5_0="IndexOB", blender="use_pass_object_index", missed=0),
    "material_index": Pass(material_index, "Pass index of the material", dtype=np.int32, shown=COUNTED,
                           label_before_5_0="IndexMA", blender="use_pass_material_index", missed=0),
    "shape_index": Pass(shape_index, "Number of the shape. Each instance has its own number", dtype=np.int32,
                        shown=COUNTED),
    "face_index": Pass(face_index, "Number of the face of the mesh after its modifiers, -1 where no face is hit",
                       dtype=np.int32, shown=COUNTED, missed=-1),
    "valid": Pass(valid, "Whether the pixel has a ray", dtype=np.bool_, shown=AS_IS),
    "ray_origin": Pass(ray_origin, "Origin of the pixel's ray in world space", "XYZ"),
    "ray_direction": Pass(ray_direction, "Unit direction of the pixel's ray in world space", "XYZ", shown=SIGNED),
    "solid_angle": Pass(solid_angle, "Solid angle of the pixel, in steradians, to first order"),
    "footprint": Pass(footprint, "Area of the surface that the pixel covers, in square Blender units, to first order",
                      missed=np.inf),
    "flow_forward": Pass(flow_forward, "Motion of the surface point to the next frame, in pixels, x and y; NaN where "
                                       "the point is not in the next picture", "XY", frames=(NEXT,)),
    "flow_backward": Pass(flow_backward, "Motion of the surface point to the previous frame, in pixels, x and y; NaN "
                                         "where the point is not in the previous picture", "XY", frames=(PREVIOUS,)),
    "flow_hidden": Pass(flow_hidden, "Whether the surface point is hidden by another surface in the next frame (X) or "
                                     "in the previous frame (Y)", "XY", np.bool_, frames=(NEXT, PREVIOUS), casts=True),
    "distance_bound": Pass(distance_bound, "Upper bound of the rounding error of distance and depth, in Blender units",
                           bounds=("distance", "depth")),
    "position_bound": Pass(position_bound, "Upper bound of the rounding error of the position, in Blender units",
                           bounds=("position",)),
    "normal_bound": Pass(normal_bound, "Upper bound of the rounding error of the unit normal", bounds=("normal",)),
}  # fmt: skip
"""Every pass by its name, in the order of the report."""
