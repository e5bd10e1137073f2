"""The exact rays of lenses that Blender does not have, with 60 digits: see truth, whose frame and vectors they use."""

from mpmath import asin, atan, cos, mpf, pi, sin, tan

from .truth import EYE, disc_place, fisheye, frame_of, planar, radius, round_place, shares


def setting(raw, name):
    return mpf(raw.settings[name])


def pitched(ray, elevation):
    """The lens turned up from the viewing direction."""
    origin, (x, y, z) = ray
    return origin, [x, y * cos(elevation) - z * sin(elevation), y * sin(elevation) + z * cos(elevation)]


def camera_obscura(raw, x, y):
    """From the wall's point through the hole."""
    depth = setting(raw, "obscura_depth")
    across, up = planar(raw, x, y, setting(raw, "obscura_width"))
    return EYE, [-across / depth, -up / depth, mpf(-1)]


def orthographic_fisheye(raw, x, y):
    point = round_place(raw, x, y)
    r = radius(point)
    return None if r > 1 else fisheye(point, asin(r * sin(setting(raw, "fov") / 2)))


def stereographic(raw, x, y):
    point = round_place(raw, x, y)
    return fisheye(point, 2 * atan(radius(point) * tan(setting(raw, "fov") / 4)))


def stereographic_fisheye(raw, x, y):
    return None if radius(round_place(raw, x, y)) > 1 else stereographic(raw, x, y)


def stereographic_panorama(raw, x, y):
    return pitched(stereographic(raw, x, y), setting(raw, "elevation"))


def dome_master(raw, x, y):
    point = round_place(raw, x, y)
    r = radius(point)
    return None if r > 1 else pitched(fisheye(point, r * setting(raw, "fov") / 2), pi / 2 - setting(raw, "tilt"))


def omnimax(raw, x, y):
    frame, (a, b) = frame_of(raw), disc_place(raw, x, y)
    wide, film = frame.width / (frame.height * frame.aspect), mpf("1.283458")
    if wide > film:
        a, b = a * wide / film, (b - 1) / film + 1
    elif wide > 1:
        b = (b - 1) / wide + 1
    else:
        b = b / wide
    r = radius((a, b))
    theta = mpf("1.411269") * r - mpf("0.09439") * r**3 + mpf("0.25674") * r**5
    origin, direction = fisheye((a, b), theta)
    if r > 1 or direction[1] < direction[2]:
        return None
    return pitched((origin, direction), setting(raw, "tilt"))


def cylindrical(raw, x, y):
    u, v = shares(raw, x, y)
    low, high = (tan(setting(raw, name)) for name in ("latitude_bottom", "latitude_top"))
    lon = setting(raw, "pan_min") + u * (setting(raw, "pan_max") - setting(raw, "pan_min"))
    return EYE, [sin(lon), low + v * (high - low), -cos(lon)]


MODELS = {
    "CAMERA_OBSCURA": camera_obscura, "FISHEYE_ORTHOGRAPHIC": orthographic_fisheye,
    "FISHEYE_STEREOGRAPHIC": stereographic_fisheye, "STEREOGRAPHIC_PANORAMA": stereographic_panorama,
    "DOME_MASTER": dome_master, "OMNIMAX": omnimax, "CYLINDRICAL": cylindrical,
}  # fmt: skip
PLANAR = {"CAMERA_OBSCURA"}
