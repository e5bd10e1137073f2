"""The programs whose files are read and written, one file each. A new program needs its own file and a word here."""

from . import (
    anipose,
    aria,
    arkitscenes,
    basalt,
    blainder,
    bop,
    bundler,
    cahvor,
    callab,
    camera_path,
    colmap,
    depthai,
    easymocap,
    euroc,
    euroc_trajectory,
    fspy,
    gaussian_splatting,
    gyroflow,
    hesai,
    hot3d,
    hugin,
    isaac_lidar,
    kalibr,
    kitti,
    lensfun,
    livox,
    llff,
    maplab,
    meshroom,
    metashape,
    mrcal,
    ncore,
    nerf,
    nerfstudio,
    nuscenes,
    nvidia,
    nvm,
    ocam,
    okvis,
    open3d,
    opencv,
    openmvg,
    opensfm,
    orbslam,
    ost,
    ouster,
    panoptic,
    polycam,
    ptgui,
    ray_table,
    realitycapture,
    realsense,
    recorded,
    ros,
    rpc,
    schops,
    stella,
    stmap,
    surround360,
    tum,
    velodyne,
    vins,
    woodscape,
)
from .parts.document import Document
from .parts.program import ProgramFiles, in_words

MODULES = (
    opencv, ros, colmap, nerfstudio, kalibr, euroc, okvis, vins, orbslam, stella, basalt, bop, realsense, mrcal, aria,
    cahvor, nvidia, ncore, woodscape, opensfm, maplab, hot3d, metashape, meshroom, realitycapture, openmvg, bundler,
    nvm, gaussian_splatting, camera_path, llff, open3d, surround360, fspy, polycam, arkitscenes, tum,
    kitti, gyroflow, ocam, lensfun, hugin, ptgui, velodyne,
    ost, depthai, anipose, easymocap, panoptic, nuscenes, callab,
    ouster, hesai, livox, isaac_lidar, blainder, recorded, schops, rpc, ray_table, nerf, euroc_trajectory, stmap,
)  # fmt: skip
PROGRAMS: tuple[ProgramFiles, ...] = tuple(module.PROGRAM for module in MODULES)
"""All programs, in the order in which messages name them."""


READ = in_words(program.name for program in PROGRAMS if program.read is not None)
"""The programs whose lenses are read, in words."""
PLACED = in_words(program.name for program in PROGRAMS if program.poses is not None)
"""The programs whose poses are read, in words."""


def program_of(document: Document) -> ProgramFiles | None:
    """Return the program that recognizes a document; a general one if no other does; None if none does."""
    for is_general in (False, True):
        for program in PROGRAMS:
            if program.general == is_general and program.recognizes(document):
                return program
    return None
