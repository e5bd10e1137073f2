"""The example scenes by name: functions that fill an empty Blender scene. Their docstrings are lines of the README."""

from . import calibrated, cameras, contents, lenses, meshes, multiperspective, panoramas, showcase, time


def _by_name(*makers):
    return {make.__name__: make for make in makers}


EXAMPLES = _by_name(
    showcase.spheres_and_planes,
    cameras.portrait,
    cameras.vertical_fit,
    cameras.orthographic,
    cameras.border,
    cameras.sheared_and_mirrored,
    cameras.animated,
    cameras.inside_a_sphere,
    cameras.far_and_small,
    contents.instances,
    contents.left_out,
    contents.cast_as,
    contents.view_layers,
    contents.empty,
)

GALLERY = {
    "Meshes": _by_name(
        meshes.toys,
        meshes.toys_cross_slit,
        meshes.real_lens,
        meshes.living_room,
        meshes.living_room_equirectangular,
        meshes.living_room_omnimax,
        meshes.rotunda_fisheye,
        meshes.rotunda_panorama,
        meshes.street,
        meshes.street_pushbroom,
        meshes.street_scanner,
        meshes.sculpture_garden,
        meshes.propeller,
        meshes.twisted_monkey,
        meshes.unrolled_monkey,
    ),
    "Lenses": _by_name(
        lenses.pinhole,
        lenses.isometric,
        lenses.camera_obscura,
        lenses.thin_lens,
        lenses.fish_tank,
        lenses.fisheye_orthographic,
        lenses.fisheye_stereographic,
        lenses.omnimax,
        lenses.dome_master,
    ),
    "Calibrated lenses": _by_name(
        calibrated.opencv_pinhole,
        calibrated.opencv_fisheye,
        calibrated.ucm,
        calibrated.eucm,
        calibrated.double_sphere,
        calibrated.fisheye624,
        calibrated.thin_prism_fisheye,
        calibrated.fov,
        calibrated.division,
        calibrated.radial_polynomial,
        calibrated.ftheta,
        calibrated.ocam,
        calibrated.ray_table,
    ),
    "Panoramas": _by_name(
        panoramas.equirectangular,
        panoramas.cubemap_face,
        panoramas.mirrorball,
        panoramas.fisheye_equidistant,
        panoramas.fisheye_equisolid,
        panoramas.fisheye_polynomial,
        panoramas.central_cylindrical,
        panoramas.cylindrical,
        panoramas.little_planet,
        panoramas.omnidirectional_stereo,
    ),
    "More than one eye": _by_name(
        multiperspective.general_linear,
        multiperspective.pushbroom,
        multiperspective.cross_slit,
        multiperspective.pencil,
        multiperspective.twisted_orthographic,
        multiperspective.strip,
    ),
    "More than one time": _by_name(
        time.slit_scan_rows,
        time.slit_scan_columns,
        time.time_displacement,
        time.rolling_shutter,
    ),
}
"""The scenes that show camera models and times, by their heading in the README."""

PICTURES = {name: make for group in GALLERY.values() for name, make in group.items()}
BY_CYCLES = (
    "toys_cross_slit",
    "living_room_omnimax",
    "living_room_equirectangular",
    "rotunda_panorama",
    "rotunda_fisheye",
    "street_pushbroom",
)
"""Scenes of PICTURES that are also rendered by Cycles through the same camera."""
SCENES = EXAMPLES | PICTURES
