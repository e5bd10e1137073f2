"""Rays through spheres, aspheres and planes with 60 digits, by roots and Snell's law: the witness of the trace."""

from mpmath import findroot, mp, mpf, sqrt

mp.dps = 60


def traced(surfaces, origin, direction):
    """The ray behind the last of some surfaces, from the scene to the film: origin and unit direction."""
    point, ahead = [mpf(number) for number in origin], [mpf(number) for number in direction]
    for surface in surfaces:
        z, curvature = mpf(surface.z), mpf(surface.curvature)
        if surface.asphere:
            point, normal = on_asphere(surface, point, ahead)
        elif curvature:
            point = on_sphere(point, ahead, z + 1 / curvature, 1 / curvature)
            normal = [point[0] * curvature, point[1] * curvature, (point[2] - z) * curvature - 1]
        else:
            t = (z - point[2]) / ahead[2]
            point, normal = [p + t * d for p, d in zip(point, ahead, strict=True)], [mpf(0), mpf(0), mpf(-1)]
        before, behind = mpf(surface.before), mpf(surface.behind)
        ahead = refracted(ahead, normal, before / behind)
    return point, ahead


def on_asphere(surface, point, ahead):
    """Where a ray meets a sphere with further powers of the radius, from where it meets the plane of the vertex, and
    the unit normal there.
    """
    curvature = mpf(surface.curvature)

    def height(x, y):
        q = x * x + y * y
        root = sqrt(1 - (1 + mpf(surface.conic)) * curvature**2 * q)
        slope = curvature / root + sum(power * mpf(term) * q ** (mpf(power) / 2 - 1) for power, term in surface.asphere)
        powers = sum(mpf(term) * q ** (mpf(power) / 2) for power, term in surface.asphere)
        return mpf(surface.z) + curvature * q / (1 + root) + powers, slope

    def at(t):
        return [p + t * d for p, d in zip(point, ahead, strict=True)]

    t = findroot(lambda t: at(t)[2] - height(*at(t)[:2])[0], (mpf(surface.z) - point[2]) / ahead[2])
    x, y, z = at(t)
    slope = height(x, y)[1]
    size = sqrt(1 + slope * slope * (x * x + y * y))
    return [x, y, z], [slope * x / size, slope * y / size, -1 / size]


def on_sphere(point, ahead, middle, radius):
    """Where a ray meets the half of a sphere with the vertex."""
    off = [point[0], point[1], point[2] - middle]
    half = sum(o * d for o, d in zip(off, ahead, strict=True))
    root = sqrt(half * half - sum(o * o for o in off) + radius * radius)
    vertex = middle - radius
    crossings = [[p + t * d for p, d in zip(point, ahead, strict=True)] for t in (-half - root, -half + root)]
    return min(crossings, key=lambda point: abs(point[2] - vertex))


def refracted(ahead, normal, ratio):
    """Snell's law for a unit normal of either sign."""
    cosine = -sum(a * n for a, n in zip(ahead, normal, strict=True))
    if cosine < 0:
        normal, cosine = [-number for number in normal], -cosine
    along = ratio * cosine - sqrt(1 - ratio * ratio * (1 - cosine * cosine))
    return [ratio * a + along * n for a, n in zip(ahead, normal, strict=True)]
