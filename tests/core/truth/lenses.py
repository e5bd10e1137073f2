"""The exact rays of lenses that Blender does not have, with 60 digits: see truth, whose frame and vectors they use."""

from mpmath import asin, atan, cos, findroot, mpf, pi, polyroots, sin, sqrt, tan

from .truth import EYE, disc_place, fisheye, frame_of, planar, radius, round_place, shares


def setting(raw, name):
    return mpf(raw.settings[name])


def pitched(found, elevation):
    """The lens turned up from the viewing direction."""
    origin, (x, y, z) = found
    return origin, [x, y * cos(elevation) - z * sin(elevation), y * sin(elevation) + z * cos(elevation)]


def camera_obscura(raw, x, y):
    """From the wall's point through the hole."""
    depth = setting(raw, "obscura_depth")
    across, up = planar(raw, x, y, setting(raw, "obscura_width"))
    return EYE, [-across / depth, -up / depth, mpf(-1)]


def orthographic_fisheye(raw, x, y):
    place = round_place(raw, x, y)
    r = radius(place)
    return None if r > 1 else fisheye(place, asin(r * sin(setting(raw, "fov") / 2)))


def stereographic(raw, x, y):
    place = round_place(raw, x, y)
    return fisheye(place, 2 * atan(radius(place) * tan(setting(raw, "fov") / 4)))


def stereographic_fisheye(raw, x, y):
    return None if radius(round_place(raw, x, y)) > 1 else stereographic(raw, x, y)


def stereographic_panorama(raw, x, y):
    return pitched(stereographic(raw, x, y), setting(raw, "elevation"))


def dome_master(raw, x, y):
    place = round_place(raw, x, y)
    r = radius(place)
    return None if r > 1 else pitched(fisheye(place, r * setting(raw, "fov") / 2), pi / 2 - setting(raw, "tilt"))


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


def distorted(raw, x, y):
    """The pixel in OpenCV's normalized, distorted coordinates, y down."""
    frame = frame_of(raw)
    width = raw.settings["calibration_width"] or frame.width
    height = raw.settings["calibration_height"] or frame.height
    half = mpf(1) / 2
    return (
        (x * width / frame.width - half - setting(raw, "cx")) / setting(raw, "fx"),
        ((frame.height - y) * height / frame.height - half - setting(raw, "cy")) / setting(raw, "fy"),
    )


def opencv_pinhole(raw, x, y):
    goal = distorted(raw, x, y)
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4 = (
        setting(raw, name) for name in ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4")
    )

    def miss(a, b):
        r = a * a + b * b
        gain = (1 + k1 * r + k2 * r**2 + k3 * r**3) / (1 + k4 * r + k5 * r**2 + k6 * r**3)
        return (
            a * gain + 2 * p1 * a * b + p2 * (r + 2 * a * a) + s1 * r + s2 * r * r - goal[0],
            b * gain + p1 * (r + 2 * b * b) + 2 * p2 * a * b + s3 * r + s4 * r * r - goal[1],
        )

    try:
        a, b = findroot(miss, goal, tol=mpf(10) ** -80)
    except ValueError:  # the lens brings no direction here
        return None
    return EYE, [a, -b, mpf(-1)]


def opencv_fisheye(raw, x, y):
    place = distorted(raw, x, y)
    r = sqrt(place[0] ** 2 + place[1] ** 2)
    k = [mpf(1), *(setting(raw, f"k{i}") for i in range(1, 5))]
    slope = [c * (2 * i + 1) for i, c in enumerate(k)]
    while slope and slope[-1] == 0:
        slope.pop()
    turns = polyroots(slope[::-1], maxsteps=200, extraprec=400) if len(slope) > 1 else []
    last = min([sqrt(t.real) for t in turns if abs(t.imag) < mpf(10) ** -40 and t.real > 0] + [pi])

    def reach(theta):
        return sum(c * theta ** (2 * i + 1) for i, c in enumerate(k))

    if r > reach(last):
        return None
    theta = findroot(lambda t: reach(t) - r, (mpf(0), last), solver="anderson", tol=mpf(10) ** -100, maxsteps=1000)
    return fisheye((place[0], -place[1]), theta)


MODELS = {
    "CAMERA_OBSCURA": camera_obscura, "FISHEYE_ORTHOGRAPHIC": orthographic_fisheye,
    "FISHEYE_STEREOGRAPHIC": stereographic_fisheye, "STEREOGRAPHIC_PANORAMA": stereographic_panorama,
    "DOME_MASTER": dome_master, "OMNIMAX": omnimax, "CYLINDRICAL": cylindrical,
    "OPENCV_PINHOLE": opencv_pinhole, "OPENCV_FISHEYE": opencv_fisheye,
}  # fmt: skip
PLANAR = {"CAMERA_OBSCURA", "OPENCV_PINHOLE"}
