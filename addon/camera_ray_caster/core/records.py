"""The plain records that the steps of a cast exchange. They hold values; the steps hold the arithmetic.

Records with arrays compare by identity: one is equal to itself only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .materials.surface import Surface
from .materials.values import Value
from .mesh import Mesh
from .timeline import ONE_TIME, Timeline


class InputError(ValueError):
    """Input of the user that cannot be cast. The message is one line that says what is wrong and what to do."""

    def __init__(self, message: str):
        super().__init__(" ".join(message.splitlines()))  # quoted text may have several lines


class Cancelled(Exception):
    """The user stopped the work."""


@dataclass(frozen=True, eq=False)
class BlenderCamera:
    """A camera and its render settings, copied from Blender; nothing is derived.

    Names, units and meanings are those of Blender's Python API (Camera, RenderSettings). ``matrix_world`` is the matrix
    of the evaluated object, (4, 4) float64. ``settings`` holds the properties that only some models have, by name.
    """

    name: str
    type: str
    matrix_world: np.ndarray
    lens: float = 50.0
    sensor_fit: str = "AUTO"
    sensor_width: float = 36.0
    sensor_height: float = 24.0
    shift_x: float = 0.0
    shift_y: float = 0.0
    ortho_scale: float = 6.0
    clip_start: float = 0.1
    clip_end: float = 1000.0
    resolution_x: int = 1920
    resolution_y: int = 1080
    resolution_percentage: int = 100
    pixel_aspect_x: float = 1.0
    pixel_aspect_y: float = 1.0
    use_border: bool = False
    border_min_x: float = 0.0
    border_max_x: float = 1.0
    border_min_y: float = 0.0
    border_max_y: float = 1.0
    use_crop_to_border: bool = False
    model: str = ""
    """Key of the model chosen in place of Blender's camera type; empty if Blender's type is used."""
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Raster:
    """The full frame in pixels, and its window that is rendered: columns x0 .. x1 - 1, rows y0 .. y1 - 1."""

    width: int
    height: int
    pixel_aspect: float
    """Height of a pixel over its width."""
    x0: int
    y0: int
    x1: int
    y1: int
    cropped: bool = False
    """Whether files of pictures have the window only; else they have the full frame, empty outside of the window."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the full frame."""
        return self.width, self.height

    @property
    def picture(self) -> tuple[int, int, int, int]:
        """The part of the frame that files of pictures have: columns x0 .. x1 - 1, rows y0 .. y1 - 1, as x0, x1, y0,
        y1.
        """
        return (self.x0, self.x1, self.y0, self.y1) if self.cropped else (0, self.width, 0, self.height)

    @property
    def picture_size(self) -> tuple[int, int]:
        """Width and height of files of pictures."""
        x0, x1, y0, y1 = self.picture
        return x1 - x0, y1 - y0

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the render window: the shape of every image."""
        return self.y1 - self.y0, self.x1 - self.x0

    def columns(self) -> np.ndarray:
        """Return the x of the window's pixel centers, (1, columns) float64, exact."""
        return np.arange(self.x0, self.x1, dtype=np.float64)[None, :] + 0.5

    def rows(self) -> np.ndarray:
        """Return the y of the window's pixel centers, (rows, 1) float64, exact."""
        return np.arange(self.y0, self.y1, dtype=np.float64)[:, None] + 0.5


@dataclass(frozen=True, eq=False)
class Pose:
    """Position and orientation of the camera: world = eye + basis @ camera."""

    eye: np.ndarray
    """(3,) float64: the camera's origin in the world."""
    basis: np.ndarray
    """(3, 3) float64: the columns are the camera's X, Y and Z axes in the world, each of unit length."""


@dataclass(frozen=True, eq=False)
class Rays:
    """The chief rays of a picture, in the world; see the conventions."""

    origins: np.ndarray
    """(rows, columns, 3) float64; a read-only broadcast view if all rays leave one eye."""
    directions: np.ndarray
    """(rows, columns, 3) float64, unit length to 8 EPS, NaN where there is no ray."""
    valid: np.ndarray
    """(rows, columns) bool."""
    time: np.ndarray | None = None
    """(rows, columns) float64: the frame at which each ray is cast; None if the picture has one time."""


@dataclass(frozen=True, eq=False)
class RaysJacobian:
    """The derivatives of a picture's chief rays, in the world, with respect to the pixel's x and y: the last axis."""

    origins: np.ndarray
    """(rows, columns, 3, 2) float64; a read-only broadcast view of 0 if all rays leave one eye."""
    directions: np.ndarray
    """(rows, columns, 3, 2) float64: derivatives of the unit directions; NaN where there is no ray."""


SPHERE, PLANE, INFINITE_PLANE, MESH = 0, 1, 2, 3
"""Values of ``Shapes.kind``."""


@dataclass(frozen=True, eq=False)
class Slots:
    """The materials of meshes that have several: those of row k of ``Shapes`` begin at ``first[k]``."""

    first: np.ndarray
    """(n,) int64; -1 for shapes with one material, which is stored in ``Shapes``."""
    material_index: np.ndarray
    """(s,) int32: pass indices of the materials."""
    color: np.ndarray
    """(s, 4) float32: linear RGBA, as ``Shapes.color``."""
    surface: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    """(s,) int32: indices into ``Shapes.surfaces``, as ``Shapes.surface``."""


AREA, EVERYWHERE = (0.0, 0.0), (-2.0, 1.0)
"""Values of ``Lights.cone``: of lights that shine by the cosine, as a small area does, and in all directions alike."""


@dataclass(frozen=True, eq=False)
class Lights:
    """Lights: ``position[k]`` is a point, or with ``is_sun`` the unit direction towards the sun.

    The arrays are (n, 3), (n,) and (n, 3). ``color`` is the light's color times its strength in Blender's units: watts
    for a lamp, watts per square meter for a sun.
    """

    position: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    is_sun: np.ndarray = field(default_factory=lambda: np.zeros(0, bool))
    color: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    axis: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    """(n, 3): the unit directions in which spot and area lights shine, 0 for others; empty if there are only others."""
    cone: np.ndarray = field(default_factory=lambda: np.zeros((0, 2)))
    """(n, 2): of spot lights the cosine at the edge of the cone and the width, in cosines, over which the light fades
    within it; AREA of area lights, EVERYWHERE of others. Empty where ``axis`` is.
    """
    left_out: tuple[tuple[str, str], ...] = ()
    """Lights that are not used, each with the reason in one line."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """The spheres, planes and meshes of a scene, one row per shape; ``shape_index`` of a pixel is the row.

    world = center + axes @ q with the unit sphere or square in q (see the conventions): a sphere may be any ellipsoid,
    a plane any parallelogram. The lengths of an infinite plane's first two axes do not limit it; they scale its uv. For
    a mesh q is a vertex minus the mesh's ``middle``; the axes of a mesh may lie in one plane.
    """

    kind: np.ndarray
    """(n,) uint8: SPHERE, PLANE, INFINITE_PLANE or MESH."""
    center: np.ndarray
    """(n, 3) float64, world."""
    axes: np.ndarray
    """(n, 3, 3) float64: the columns are the images of the shape's axes. Invertible, which the reader ensures, except
    for meshes.
    """
    object_index: np.ndarray
    """(n,) int32: the object's pass index."""
    material_index: np.ndarray
    """(n,) int32: the material's pass index, 0 without a material."""
    color: np.ndarray
    """(n, 4) float32: linear RGBA for the combined pass."""
    name_index: np.ndarray
    """(n,) int32: indices into ``names``; instances and points share the name of their object."""
    names: tuple[str, ...] = ()
    instanced: tuple[bool, ...] = ()
    """Whether each of ``names`` stands for instances of the object, not for the object itself; empty if none does."""
    materials: tuple[tuple[int, str], ...] = ()
    """Pass index and name of each material of the shapes."""
    lights: Lights = field(default_factory=Lights)
    world_color: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    """RGBA of the background, and of the light from all directions: the mean of a background that changes."""
    background: Value | None = None
    """The color of the background by ``DIRECTION``, three channels; None if it is the world's color."""
    left_out: tuple[tuple[str, str], ...] = ()
    """Objects that are not cast, each with the reason in one line."""
    meshes: tuple[Mesh, ...] = ()
    mesh: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    """(n,) int32: indices into ``meshes``, -1 for other shapes; empty if there are no meshes."""
    shared: np.ndarray = field(default_factory=lambda: np.zeros(0, bool))
    """(n,) bool: whether normals of the mesh are interpolated in its own frame, as in Cycles for a mesh that several
    objects share, and not in the world; empty if there are no meshes.
    """
    slots: Slots | None = None
    """Materials of meshes that have several; None if no mesh has more than one."""
    unread: tuple[tuple[str, str], ...] = ()
    """Materials whose colors are not read, each with what is not, in one line: they show their viewport colors."""
    surfaces: tuple[Surface, ...] = ()
    """The materials that change over a surface or glow."""
    surface: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    """(n,) int32: indices into ``surfaces``, -1 where ``color`` is the material's; empty if there are no surfaces."""
    identity: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    """(n,) int64: equal in two readings of a scene for the same instance of the same object and the same point of a
    cloud; empty if shapes are known by their names only.
    """
    exact: tuple[tuple[str, float], ...] = ()
    """Objects whose mesh is cast as an exact sphere or plane, each with the largest distance between the two, over the
    radius or the plane's longer half side.
    """
    uv: np.ndarray | None = None
    """(names, 2, 3) float64: the UV map of spheres and planes by ``name_index``, affine in the two coordinates of the
    surface: (u, v) = uv @ (first, second, 1). None if u and v are the coordinates themselves.
    """
    notes: tuple[tuple[str, str], ...] = ()
    """Objects and materials that passes show otherwise than their settings or Cycles, each with the difference."""
    timeline: Timeline = ONE_TIME
    """The shapes, and the camera that sees them, at other times."""

    def __len__(self) -> int:
        return len(self.kind)

    def __repr__(self) -> str:
        counts = zip(np.bincount(self.kind), ("sphere", "plane", "infinite plane", "mesh"), strict=False)
        return f"<Shapes {', '.join(f'{kind}: {count}' for count, kind in counts if count) or 'none'}>"

    def at(self, frame: float) -> Shapes:
        """Return the shapes at a frame: themselves if they do not move."""
        motion = self.timeline.motion
        return self if motion is None else motion.shapes_at(frame)


def no_shapes() -> Shapes:
    """Return the shapes of an empty scene."""
    none = np.zeros(0, np.int32)
    places, colors = np.zeros((0, 3)), np.zeros((0, 4), np.float32)
    return Shapes(none.astype(np.uint8), places, np.zeros((0, 3, 3)), none, none, colors, none)


@dataclass(frozen=True)
class Finding:
    """The errors of a camera's rays against one independent reference, and the bounds that the reference can reach."""

    witness: str
    points: int
    worst_pixels: float
    median_pixels: float
    bound_pixels: float
    worst_radians: float
    median_radians: float
    bound_radians: float
    not_compared: str = ""
    """Reason why nothing was compared; empty if there was a comparison."""

    @property
    def passed(self) -> bool:
        """Whether no error exceeds its bound. NaN fails; a finding without a comparison passes."""
        if self.not_compared:
            return True
        return self.worst_pixels <= self.bound_pixels and self.worst_radians <= self.bound_radians
