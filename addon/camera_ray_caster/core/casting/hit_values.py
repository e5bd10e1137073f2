"""Values derived from hits: directions, points, normals, uv, errors.

Each value is computed when a pass first needs it, once for all passes of a block, in working arrays of the thread.
"""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from ..camera.jacobian import RayDerivatives
from ..errors.hit_errors import HitErrors
from ..materials.surface import Surface
from ..maths.speed import Scratch, lazy
from ..maths.vector import dot, inner, is_lattice, is_one, linear, matvec, norm
from ..shapes.kind import HitPixels, Kind
from ..shapes.kinds import by_kind
from ..shapes.surface_places import KindPlaces, SurfacePlaces, material_rows
from .hits import Hits
from .target import RayTarget

T = TypeVar("T")

ZERO = np.zeros((3, 1, 1))
"""A term of a vector sum that adds nothing."""


class HitValues:
    """The values of a block of hits; vectors are three (rows, columns) components in the world."""

    def __init__(self, hits: Hits):
        self.hits = hits
        self.flows: dict[str, Any] = {}
        """The flows to other frames, by name, which the passes of a block share; see ``flow``."""

    @property
    def target(self) -> RayTarget:
        """What the rays are cast at."""
        return self.hits.target

    @property
    def scratch(self) -> Scratch:
        """The working arrays of the thread."""
        return self.hits.rays.scratch

    def array(self, name: str, *channels: int) -> np.ndarray:
        """Return the working array of this name, (*channels, rows, columns) float64; its earlier content is lost."""
        return self.scratch(name, (*channels, *self.hits.t.shape), np.float64)

    @lazy
    def index(self) -> np.ndarray:
        """The index of the hits in numpy's type for indices."""
        index = self.scratch("index as intp", self.hits.index.shape, np.intp)
        np.copyto(index, self.hits.index if self.hits.shape is None else self.hits.shape)
        return index

    def look_up(self, table: np.ndarray, out: str) -> np.ndarray:
        """Return the entries of a table (..., n + 1) for the pixels' shapes, the last entry where nothing is hit; they
        broadcast to (..., rows, columns). They may be in the working array of the name ``out``, which the next call
        with this name overwrites.
        """
        if self.hits.shape is not None:
            return table[..., self.hits.shape, None, None]
        array = self.scratch(out, table.shape[:-1] + self.hits.t.shape, table.dtype.type)
        return np.take(table, self.index, axis=-1, mode="wrap", out=array)

    @lazy
    def direction(self) -> Any:
        """The directions of the rays, not of unit length."""
        if self._lattice is None:
            return matvec(self.target.pose.basis, self.hits.rays.direction)
        return np.add(*self._lattice, out=self.array("direction", 3))

    @lazy
    def length(self) -> np.ndarray:
        """The length of ``direction``: distance over t; (1, 1) for parallel rays."""
        if is_one(self.direction):
            return np.full((1, 1), norm(self.direction))
        length, spare = self.array("length"), self.array("spare")
        return np.sqrt(inner(self.direction, self.direction, length, spare), out=length)

    @property
    def distance(self) -> np.ndarray:
        """Distance from the rays' origins to the hits; inf where nothing is hit."""
        return self.hits.t * self.length

    @lazy
    def _lattice(self) -> tuple[np.ndarray, np.ndarray] | None:
        """The two terms of a pinhole's directions, (3, 1, columns) and (3, rows, 1); None for other cameras."""
        if not is_lattice(self.hits.rays.direction):
            return None
        x, y, z = self.hits.rays.direction
        to_x, to_y, to_z = self.target.pose.basis.T[..., None, None]
        return to_x * x, to_y * y + to_z * z

    @lazy
    def point(self) -> np.ndarray:
        """The hit points relative to the eye, (3, rows, columns); undefined where nothing is hit."""
        point = self.array("point", 3)
        if self._lattice is not None:
            np.add(*self._lattice, out=point)
        else:
            self._to_world(self.hits.rays.direction, point)
        np.multiply(point, self.hits.t, out=point)
        if not self.hits.rays.from_eye:
            np.add(self._to_world(self.hits.rays.origin, self.array("offset", 3)), point, out=point)
        return point

    def _to_world(self, vector: Any, out: np.ndarray) -> np.ndarray:
        """Return camera-frame components as world components, written to ``out``."""
        axes = self.target.pose.basis.T[..., None, None]
        return linear(axes, vector, out, self.array("spare", 3))

    @lazy
    def normal_terms(self) -> tuple[np.ndarray, np.ndarray]:
        """Two terms whose sum is ``normal`` where something is hit, so that storing the normal can add them."""
        table, normal = self.target.normals, self.array("turned", 3)
        faces_eye = self.hits.faces_eye
        others = [(self.look_up(mask, f"others {k}"), normals) for k, (mask, normals) in enumerate(table.others)]
        if not (others and (np.logical_or.reduce([mask for mask, _ in others]) >= self.hits.seen).all()):
            offset = self.look_up(table.offset, "offset of normals")
            gain = None if table.gain is None else self.look_up(table.gain, "gain of normals")
            if gain is None or (gain.size == 1 and gain == 0):
                np.copyto(normal, offset)
            else:
                np.multiply(gain, self.point, out=normal)
                if faces_eye and table.is_sum:
                    return normal, offset
                np.add(normal, offset, out=normal)
            if not table.unit:
                np.divide(normal, np.maximum(norm(normal), np.finfo(float).tiny), out=normal)
            if not faces_eye:
                np.multiply(-np.sign(dot(normal, self.direction)), normal, out=normal)
        for mask, normals in others:
            if not (where := mask & self.hits.seen).any():
                continue
            pixels = self.pixels(where)
            direction = None if faces_eye else pixels.of(self.direction)
            of_kind = normals(pixels, pixels.of(self.point), direction)
            if pixels.is_whole:
                return np.reshape(of_kind, normal.shape), ZERO
            for component, values in zip(normal, of_kind, strict=True):
                component.reshape(-1)[pixels.places] = values
        return normal, ZERO

    @lazy
    def normal(self) -> np.ndarray:
        """Unit normals turned towards the rays' origins, (3, rows, columns); 0 where nothing is hit."""
        normal = np.add(*self.normal_terms, out=self.array("normal", 3))
        if self.hits.missed is not None:
            np.copyto(normal, 0.0, where=self.hits.missed)
        return normal

    def by_kind(self, of: Callable[[Kind, HitPixels], T]) -> list[tuple[np.ndarray, T]]:
        """Return for each kind that is hit its pixels, (rows, columns) bool, and the result of a function for them."""
        return [(pixels.where, of(kind, pixels)) for kind, pixels in self._kinds]

    @lazy
    def _kinds(self) -> list[tuple[Kind, HitPixels]]:
        """The kinds that are hit, each with its pixels."""
        kinds = self.look_up(self.target.kinds, "kinds")
        return [(kind, self.pixels(where & self.hits.seen)) for kind, where in by_kind(kinds)]

    @lazy
    def cosine(self) -> np.ndarray:
        """Cosine of the angle between the ray and the normal of the surface itself, (rows, columns), not negative;
        undefined where nothing is hit.
        """
        cosine, spare = self.array("cosine"), self.array("spare")
        np.divide(inner(self.normal, self.direction, cosine, spare), self.length, out=cosine)
        for where, of_surface in self.by_kind(self._surface_cosine):
            if of_surface is not None:
                cosine[where] = of_surface
        return np.abs(cosine, out=cosine)

    def _surface_cosine(self, kind: Kind, pixels: HitPixels) -> Any:
        """Return the cosine for pixels of a kind whose ``normal`` is not the surface's own; None for other kinds."""
        normal = kind.surface_normals(self.target.placed, pixels)
        if normal is None:
            return None
        direction = pixels.of(self.direction)
        return dot(normal, direction) / (norm(normal) * norm(direction))

    @lazy
    def derivatives(self) -> RayDerivatives:
        """The derivatives of the rays with respect to the pixel."""
        rays, camera = self.hits.rays, self.hits.rays.of_camera
        return RayDerivatives(camera.model, camera.pose, rays.x, rays.y)

    @lazy
    def uv(self) -> list[tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]]:
        """The UV maps, kind by kind: the pixels of the kind, (rows, columns) bool, and u and v there."""
        return self.by_kind(lambda kind, pixels: kind.uv(self.target.placed, pixels, pixels.of(self.point)))

    @property
    def coordinates(self) -> list[tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]]:
        """The coordinates of the surfaces themselves, kind by kind: see ``Kind.coordinates``."""
        return self.by_kind(lambda kind, pixels: kind.coordinates(self.target.placed, pixels, pixels.of(self.point)))

    @property
    def from_edge(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """The distances of the hits from the edges of faces without uv, kind by kind: see ``Kind.from_edge``."""
        return self.by_kind(lambda kind, pixels: kind.from_edge(self.target.placed, pixels, pixels.of(self.point)))

    @lazy
    def material(self) -> np.ndarray:
        """The rows of the hit materials in the target's tables, (rows, columns) intp."""
        if self.target.shapes.slots is None:
            return self.index
        row = self.index.copy()
        for where, slot in self.by_kind(lambda kind, pixels: kind.slot(self.target.placed, pixels)):
            row[where] = material_rows(self.target.shapes, row[where], slot)
        return row

    def of_material(self, table: np.ndarray, out: str) -> np.ndarray:
        """Return a table's entries, (n + s + 1,), for the hit materials, in the working array of the name ``out``."""
        array = self.scratch(out, self.hits.t.shape, table.dtype.type)
        if self.hits.shape is not None and self.target.shapes.slots is None:
            array.fill(table[self.hits.shape])
            return array
        return np.take(table, self.material, mode="wrap", out=array)

    @lazy
    def painted(self) -> list[tuple[Surface, np.ndarray, SurfacePlaces]]:
        """The surfaces that are hit and have no plain color: each with the flat indices of its pixels, (k,), and their
        points.
        """
        painted, shapes = [], self.target.shapes
        if shapes.surfaces:
            for kind, pixels in self._kinds:
                places = KindPlaces(kind, self.target.placed, pixels, pixels.of(self.point))
                for number, indices in places.each_surface():
                    painted.append((shapes.surfaces[number], pixels.places[indices], SurfacePlaces(places, indices)))
        return painted

    @lazy
    def errors(self) -> list[tuple[np.ndarray, HitErrors]]:
        """The error bounds of the hits, kind by kind; see ``by_kind``."""
        return self.errors_at(self.hits.seen)

    def errors_at(self, where: np.ndarray) -> list[tuple[np.ndarray, HitErrors]]:
        """Return the error bounds of the hits in some pixels, (rows, columns) bool, kind by kind; see ``by_kind``."""
        placed, unit, rays = self.target.placed, self.target.normals.unit, self.hits.rays.in_world()
        kinds = [(kind, self.pixels(pixels.where & where)) for kind, pixels in self._kinds]
        return [(hit.where, HitErrors(placed, kind, hit, rays.only(hit.of), unit)) for kind, hit in kinds]

    def pixels(self, where: np.ndarray) -> HitPixels:
        """Return the pixels marked in ``where``, each of which hits something."""
        hits = self.hits
        return HitPixels(where, (self.index, hits.t), hits.window, hits.rays.from_eye, hits.known)
