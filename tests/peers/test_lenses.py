"""Rays of real lenses beside two programs of optical design, Optiland and RayOptics.

Both follow them as the camera does, against the light: from the film, or from the stop. They see a mirrored lens.
"""

from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc

pytestmark = pytest.mark.full

LENSES = "double_gauss_50mm", "tessar_100mm", "petzval_50mm", "telephoto_127mm", "retrofocus_22mm", "fisheye_170_5mm"
DISTANCES = 1.5, 5.0, 1000.0
COUNT = 300
MIRROR = np.array([1.0, 1.0, -1.0])


@pytest.fixture(scope="module")
def cameras():
    """Cameras with some pixels and points of the aperture, within the disc and beyond it."""
    rng, made = np.random.default_rng(0), {}
    for number, (name, distance) in enumerate((name, distance) for name in LENSES for distance in DISTANCES):
        stop = {"use_dof": True, "aperture_fstop": (1.0, 5.6)[number % 2]}
        camera = crc.camera("REAL_LENS", (1920, 1280), lens_file=name, focus_distance=distance, **stop)
        x, y, points = rng.uniform(0, 1920, COUNT), rng.uniform(0, 1280, COUNT), rng.uniform(-1, 1, (2, COUNT))
        made[f"{name} at {distance}"] = camera, x, y, points
    return made


@pytest.mark.parametrize("kind", ["optiland", "rayoptics"])
def test_rays_of_the_aperture_pass_as_in_programs_of_optical_design(read, tmp_path, cameras, kind):
    bundles = {}
    for name, (camera, x, y, points) in cameras.items():
        model, pupil = camera.model, camera.aperture
        surfaces = list(model.optics.surfaces)
        surfaces[model.optics.stop] = replace(surfaces[model.optics.stop], rim=float(pupil.stop_radius))
        a, b = model.window.plane_from_pixels(x, y)
        crossing, film = model.chief.crossing(a * a + b * b), np.full(COUNT, float(model.film))
        start = np.stack((-a, -b, film), axis=1)
        crossed = pupil.disc * points - crossing * np.stack((a, b))
        ahead = np.stack((*crossed, np.full(COUNT, pupil.plane)), axis=1) - start
        ahead *= np.sign(-ahead[:, 2:]) / np.linalg.norm(ahead, axis=1)[:, None]
        bundles |= bundle(name, surfaces[::-1], False, start, ahead)
    theirs = followed(read, tmp_path, kind, bundles)
    for name, (camera, x, y, points) in cameras.items():
        with np.errstate(invalid="ignore"):
            ours = camera.model.through(camera.aperture, None, x, y, camera.aperture.radius * points)
        passes = np.isfinite(ours[1][0])
        assert np.array_equal(passes, np.isfinite(theirs[name][:, 3])), name
        assert 5 < passes.sum() < COUNT
        compare(camera.model, ours, theirs[name], passes, (1e-11, 1e-13))


@pytest.mark.parametrize("kind", ["optiland", "rayoptics"])
def test_chief_rays_begin_at_the_center_of_the_stop_in_programs_of_optical_design(read, tmp_path, cameras, kind):
    """From the stop to the film, which gives the pixel, and to the scene, which gives its ray."""
    bundles, rng = {}, np.random.default_rng(1)
    for name, (camera, *_) in cameras.items():
        surfaces, stop = camera.model.optics.surfaces, camera.model.optics.stop
        angle, turn = rng.uniform(0.0, 0.6, COUNT), rng.uniform(0, 2 * np.pi, COUNT)
        to_film = np.stack((-np.sin(angle) * np.cos(turn), -np.sin(angle) * np.sin(turn), np.cos(angle)), axis=1)
        start = np.tile((0.0, 0.0, surfaces[stop].z), (COUNT, 1))
        bundles |= bundle(f"{name}, film", surfaces[stop + 1 :], True, start, to_film)
        bundles |= bundle(f"{name}, scene", surfaces[:stop][::-1], False, start, -to_film)
    theirs = followed(read, tmp_path, kind, bundles)
    for name, (camera, *_) in cameras.items():
        model, film = camera.model, theirs[f"{name}, film"]
        a, b = -(film[:, :2] + (model.film - film[:, 2:3]) * film[:, 3:5] / film[:, 5:]).T
        passes = np.isfinite(a) & np.isfinite(theirs[f"{name}, scene"][:, 3])
        with np.errstate(invalid="ignore"):
            ours = model.rays(*model.window.pixels_from_plane(a, b))
        # where r stops growing, the last 0.1 % of the stop's angles are not used
        assert (np.hypot(a, b)[passes] < 1.002 * model.chief.rim).all()
        inside = passes & (np.hypot(a, b) < model.chief.rim)
        assert np.array_equal(inside, np.isfinite(ours[1][0])), name
        assert inside.sum() > 20
        # the polynomials err by up to 1.1e-13 radians, those of the Petzval lens
        compare(model, ours, theirs[f"{name}, scene"], inside, (1e-11, 2e-13))


def bundle(name, surfaces, to_film, start, ahead):
    """The arrays of a bundle for the reader; rays to the scene are mirrored."""
    rows = [[each.z, each.curvature, each.rim, each.before, each.behind] if to_film else
            [-each.z, -each.curvature, each.rim, each.behind, each.before] for each in surfaces]  # fmt: skip
    sign = 1.0 if to_film else MIRROR
    return {f"{name}_rows": rows, f"{name}_origin": start * sign, f"{name}_direction": ahead * sign}


def followed(read, folder, kind, bundles):
    """Points and directions, (n, 6), as the program has them, in the frame of the lens."""
    path = folder / "bundles.npz"
    np.savez(path, **bundles)
    return {
        name: ends if name.endswith("film") else ends * [*MIRROR, *MIRROR] for name, ends in read(kind, path).items()
    }


def compare(model, ours, theirs, passes, most):
    """Whether origins, in mm of the lens, and directions of rays that pass are the same."""
    origin, direction = (np.stack(np.broadcast_arrays(*vectors), axis=1)[passes] for vectors in ours)
    origin = origin / model.unit + [0.0, 0.0, model.pupil]
    assert np.abs(origin - theirs[passes, :3]).max() < most[0]
    assert np.abs(direction - theirs[passes, 3:]).max() < most[1]
