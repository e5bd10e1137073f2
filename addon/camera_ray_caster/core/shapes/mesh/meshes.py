"""Triangle meshes: world = center + axes @ (vertex - the mesh's middle), any affine image of any mesh."""

import numpy as np

from ...records import MESH, Shapes
from ...shape_records import KIND_NAMES
from ..cutouts import Cutouts
from ..kind import HitPixels, Kind, PixelNormals, Visible
from ..shape_frames import InCamera, WorldRays
from ..surface_points import Follow
from .errors import TriangleErrors
from .mesh_bodies import TriangleBodies
from .mesh_in_camera import MeshesInView
from .mesh_normals import TriangleNormals
from .mesh_points import follow_meshes
from .mesh_search import MeshSet
from .mesh_surface import HitTriangles


class Meshes(Kind):
    """Triangle meshes, seen from both sides; triangles without area are invisible."""

    number = MESH
    name = KIND_NAMES[MESH]
    may_be_flat = True

    def extent(self, shapes: Shapes, at: np.ndarray, axes: np.ndarray):
        """See ``Kind``; the extent is that of the mesh's bounding box."""
        half = np.array([shapes.meshes[k].half_size for k in shapes.mesh[at].tolist()])[..., None] * axes
        return np.sqrt((np.abs(half).sum(axis=1) ** 2).sum(axis=1)), np.abs(half[..., 2]).sum(axis=1)

    def is_close(self, offset: np.ndarray, shape_from_world: np.ndarray, away: np.ndarray) -> np.ndarray:
        """See ``Kind``; always False, since vertices are transformed to the camera's frame instead."""
        return np.zeros(len(offset), bool)

    def shape_set(self, shapes: InCamera, visible: Visible) -> MeshSet:
        if isinstance(visible.whole, MeshSet):
            return visible.whole.at(visible.pixels)
        cutouts = Cutouts.of(self, shapes, visible.at)
        return MeshSet(MeshesInView(shapes, visible), visible.clip_start, cutouts)

    def bodies(self, shapes: InCamera, at: np.ndarray, parts: np.ndarray | None = None) -> TriangleBodies:
        """See ``Kind``: each triangle is a body."""
        return TriangleBodies(shapes, at, parts, Cutouts.of(self, shapes, at))

    def normals(self, shapes: InCamera, at: np.ndarray) -> tuple[np.ndarray, PixelNormals | None]:
        """See ``Kind``; each pixel's normal comes from its triangle."""

        def normals(pixels: HitPixels, point, direction):
            return TriangleNormals.of(shapes, pixels).at(pixels, point, direction)

        return np.full((len(at), 4), np.nan), normals

    def surface_normals(self, shapes: InCamera, pixels: HitPixels):
        """See ``Kind``: the normals of the triangles, not the interpolated normals."""
        triangles = HitTriangles.of(shapes, pixels)
        return tuple(triangles.each(component) for component in triangles.area)

    def uv(self, shapes: InCamera, pixels: HitPixels, point) -> tuple[np.ndarray, np.ndarray]:
        """See ``Kind``: the render UV map, or 0 if the mesh has none."""
        return HitTriangles.of(shapes, pixels).uv(point)

    def follow(self, shapes: InCamera, pixels: HitPixels, point) -> Follow:
        """See ``Kind``: points move with the frames, or with their triangles if a mesh changes its form or is flat."""
        with_frames = super().follow(shapes, pixels, point)
        return follow_meshes(with_frames, HitTriangles.of(shapes, pixels), point)

    def from_edge(self, shapes: InCamera, pixels: HitPixels, point) -> np.ndarray:
        """See ``Kind``; edges within a face do not count."""
        return HitTriangles.of(shapes, pixels).from_edge(point)

    def polygon(self, shapes: InCamera, pixels: HitPixels) -> np.ndarray:
        return HitTriangles.of(shapes, pixels).polygon

    def in_object(self, shapes: InCamera, pixels: HitPixels, point) -> np.ndarray:
        return HitTriangles.of(shapes, pixels).in_object(point)

    def layer(self, shapes: InCamera, pixels: HitPixels, point, name: str, channels: int) -> np.ndarray:
        return HitTriangles.of(shapes, pixels).layer(point, name, channels)

    def slot(self, shapes: InCamera, pixels: HitPixels) -> np.ndarray:
        return HitTriangles.of(shapes, pixels).slot

    def errors(self, shapes: InCamera, pixels: HitPixels, rays: WorldRays, from_eye: bool, unit: bool):
        return TriangleErrors(HitTriangles.of(shapes, pixels), pixels.t, rays)


MESHES = Meshes()
