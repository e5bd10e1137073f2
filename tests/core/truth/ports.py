"""The exact rays of cameras behind glass, with 60 digits: planes, spheres and Snell's law, one face after the other."""

from mpmath import cos, mpf, sin, sqrt

from .truth import along, dot, exact, minus, norm

MM = mpf(1) / 1000


def behind(raw, ray):
    """Origin and direction, in the camera's frame, behind the port of a record of a ray in air; None without one."""
    port = raw.settings.get("port", "NONE")
    if port == "NONE" or ray is None:
        return ray
    point, ahead = ray
    ahead = [number / norm(ahead) for number in ahead]
    number = {name: mpf(value) for name, value in raw.settings.items() if isinstance(value, float)}
    thickness, inside, glass, medium = (number[f"port_{name}"] for name in ("thickness", "inside", "glass", "medium"))
    if port == "FLAT":
        x, y = number["port_tilt_x"], number["port_tilt_y"]
        normal = [-cos(x) * sin(y), sin(x), -cos(x) * cos(y)]
        inner = number["port_distance"] * MM
        faces = [Plane(normal, inner), Plane(normal, inner + thickness * MM)]
    else:
        center = [number * MM for number in exact(raw.settings["port_decenter"])]
        outer = number["port_radius"] * MM
        faces = [Sphere(center, outer - thickness * MM), Sphere(center, outer)]
    for face, before, after in zip(faces, (inside, glass), (glass, medium), strict=True):
        t = face.crossing(point, ahead)
        if t is None:
            return None
        point = along(point, ahead, t)
        ahead = refracted(ahead, face.normal(point), before / after)
        if ahead is None:
            return None
    return point, ahead


class Plane:
    def __init__(self, normal, distance):
        self.away, self.distance = normal, distance

    def crossing(self, point, ahead):
        slope = dot(self.away, ahead)
        return (self.distance - dot(self.away, point)) / slope if slope > 0 else None

    def normal(self, point):
        return self.away


class Sphere:
    def __init__(self, center, radius):
        self.center, self.radius = center, radius

    def crossing(self, point, ahead):
        """From inside."""
        start = minus(point, self.center)
        half = dot(start, ahead)
        return -half + sqrt(half * half - dot(start, start) + self.radius**2)

    def normal(self, point):
        return [number / self.radius for number in minus(point, self.center)]


def refracted(ahead, normal, ratio):
    """Snell's law: the sines of the angles to the normal, which points ahead, are as one over the indices; None for
    total reflection.
    """
    cosine = dot(ahead, normal)
    tangential = [ratio * (a - cosine * n) for a, n in zip(ahead, normal, strict=True)]
    square = 1 - dot(tangential, tangential)
    return None if square < 0 else along(tangential, normal, sqrt(square))
