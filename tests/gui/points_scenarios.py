"""What a user sees of a scanner's points, one scenario a function: see scenarios.py."""

import bpy
import numpy as np
from parts import addon, load


def scanned_points(user, scenes):
    """The points of a scanner lie on the street in colors, grow by the timeline, and go."""
    yield from load(user, scenes, "street_scanner")
    scene, space, view = bpy.context.scene, user.area().spaces.active, user.region("WINDOW")
    overlay = scene.camera_ray_caster_overlay
    overlay.show_frustum = overlay.show_rays = overlay.show_hits = overlay.show_normals = False
    seen = space.region_3d
    seen.view_rotation, seen.view_location, seen.view_distance = (0.716, 0.4391, 0.2899, 0.4592), (0, 0, 0), 40
    yield from user.wait(1)
    off = user.cut(user.picture("points_off"), view)
    overlay.show = overlay.show_points = True
    user.area().tag_redraw()  # as a click on the switch does
    points = addon("view3d.hit_points")
    yield from user.until(lambda: points._drawn, "the points are measured")

    def shown(name):
        user.area().tag_redraw()
        yield from user.wait(1)
        picture = user.cut(user.picture(f"points_{name}"), view)
        return picture, np.count_nonzero(np.abs(picture - off).max(axis=2) > 0.1)

    pictures = []
    for by in ("RING", "RANGE", "LABEL"):
        overlay.points_by = by
        picture, count = yield from shown(by.lower())
        assert count > 90_000  # 102,000; 74,000 where surfaces hide parts of the points on them
        assert all(np.count_nonzero(np.abs(picture - other).max(axis=2) > 0.1) > 60_000 for other in pictures)
        pictures.append(picture)
    scene.render.fps, overlay.show_sweep = 40, True
    counts = []
    for frame in (1, 2, 3, 4):
        scene.frame_set(frame)
        counts.append((yield from shown(f"sweep_{frame}"))[1])
    assert (np.diff(counts) > 5000).all(), counts
    scene.frame_set(1)
    overlay.show = False
    _, count = yield from shown("gone")
    assert count < 100


POINTS_SCENARIOS = (scanned_points,)
