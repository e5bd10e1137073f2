"""Runs in an environment of its own, with the readers of other programs: KIND FILE OUTPUT.npz."""

import sys

import numpy as np


def ouster(path):
    """Points of two ranges, in millimeters from behind the beams' origins, in Ouster's sensor frame."""
    from ouster.sdk.core import SensorInfo, XYZLut

    with open(path) as file:
        info = SensorInfo(file.read())
    shape = info.format.pixels_per_column, info.format.columns_per_frame
    lut, behind = XYZLut(info, use_extrinsics=False), float(np.hypot(*info.beam_to_lidar_transform[[0, 2], 3]))
    near, far = (lut(np.full(shape, length, np.uint32)) for length in (10_000, 20_000))
    return {"near": near, "far": far, "behind": behind / 1000}


def velodyne(path):
    """The points of the packets of a VLP-16, with their rings, columns and times."""
    import velodyne_decoder as vd

    with open(path, "rb") as file:
        data = file.read()
    packets = vd.PacketVector()
    for first in range(0, len(data), 1206):
        packets.append(vd.VelodynePacket(float(first) / 1206 * 24 * 55.296e-6, data[first : first + 1206]))
    config = vd.Config(model=vd.Model.VLP16, min_range=0.0, max_range=200.0, timestamp_first_packet=True)
    _, points = vd.ScanDecoder(config).decode(packets, as_pcl_structs=True)
    return {name: points[name] for name in points.dtype.names}


def ply(path):
    """The columns of the vertices."""
    from plyfile import PlyData

    vertex = PlyData.read(path)["vertex"]
    return {column.name: np.array(vertex[column.name]) for column in vertex.properties}


def open3d(path):
    """The attributes of the points."""
    import open3d as o3d

    columns_of = {name: values.numpy() for name, values in o3d.t.io.read_point_cloud(path).point.items()}
    places, normals = (columns_of.pop(name) for name in ("positions", "normals"))
    columns = {name: values[:, 0] for name, values in columns_of.items()}
    return columns | {name: places[:, k] for k, name in enumerate("xyz")} | {"normals": normals}


def pcd(path):
    """The fields."""
    from pypcd4 import PointCloud

    cloud = PointCloud.from_path(path)
    return {name: cloud.pc_data[name] for name in cloud.fields}


def las(path):
    """The dimensions, in the file's scale."""
    import laspy

    cloud = laspy.read(path)
    columns = {name: np.array(cloud[name]) for name in cloud.point_format.dimension_names}
    return columns | {"x": np.array(cloud.x), "y": np.array(cloud.y), "z": np.array(cloud.z)}


def colmap(path):
    """Of each image of a sparse model: name, pose, and how far its points are from where its camera sees them."""
    import pycolmap

    model = pycolmap.Reconstruction(path)
    images = list(model.images.values())
    apart = []
    for image in images:
        seen = [point for point in image.points2D if point.has_point3D()]
        places = image.cam_from_world() * np.array([model.points3D[point.point3D_id].xyz for point in seen])
        pixels = image.camera.img_from_cam(places)
        expected = np.array([point.xy for point in seen])
        off = np.abs(pixels - expected)
        if image.camera.model.name == "EQUIRECTANGULAR":  # the columns meet at the poles
            off[:, 0] *= np.sin(np.pi * expected[:, 1] / image.camera.height)
        apart.append(off.max())
    return {
        "name": [image.name for image in images], "lens": [image.camera.model.name for image in images],
        "pose": [image.cam_from_world().matrix() for image in images], "apart": apart,
    }  # fmt: skip


def coco(path):
    """Of each image, by its name: the shape that each pixel shows, by its mask; -1 for none."""
    from pycocotools.coco import COCO

    known, shown = COCO(path), {}
    for image in known.loadImgs(known.getImgIds()):
        shapes = np.full((image["height"], image["width"]), -1)
        for annotation in known.loadAnns(known.getAnnIds(image["id"])):
            shapes[known.annToMask(annotation) == 1] = annotation["shape_index"]
        shown[image["file_name"]] = shapes
    return shown


def fisheyes(path):
    """The points that the depths of a fisheye stand for, in the frame of another, and where that one sees them, of each
    frame.
    """
    import cv2

    with np.load(path) as file:
        depths, K, D, turns, shifts, other_K, other_D = (file[name] for name in file)
    rows, columns = np.indices(depths[0].shape)
    pixels = np.stack((columns, rows), axis=-1).reshape(-1, 1, 2).astype(float)
    until = cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 100, 1e-15
    x, y = cv2.fisheye.undistortPoints(pixels, K, D, criteria=until)[:, 0].T
    rays = np.stack((x, y, np.ones_like(x)), axis=-1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)  # a fisheye's depths are distances
    still = np.zeros(3)
    points = [rays * depth.reshape(-1, 1) @ turn.T + shift
              for depth, turn, shift in zip(depths, turns, shifts, strict=True)]  # fmt: skip
    seen = [cv2.fisheye.projectPoints(view[:, None], still, still, other_K, other_D)[0][:, 0] for view in points]
    return {"points": points, "pixels": seen}


def optiland(path):
    """Rays behind the last of some surfaces; see ``traced``."""
    from optiland.materials import IdealMaterial
    from optiland.optic import Optic
    from optiland.rays import RealRays

    def through(rows, origin, direction):
        lens = Optic()
        lens.surfaces.add(index=0, z=rows[0, 0] - 1.0, material=IdealMaterial(rows[0, 3]))
        for number, (z, curvature, rim, _, behind) in enumerate(rows, 1):
            radius, rim = 1 / curvature if curvature else np.inf, 2 * rim if rim < np.inf else None
            lens.surfaces.add(index=number, z=z, radius=radius, aperture=rim, material=IdealMaterial(behind))
        light, length = np.ones(len(origin)), np.full(len(origin), 0.5875618)
        rays = lens.surfaces.trace(RealRays(*origin.T, *direction.T, light, length), skip=1)
        ends = np.stack((rays.x, rays.y, rays.z, rays.L, rays.M, rays.N), axis=1)
        return np.where((rays.i > 0)[:, None], ends, np.nan)

    return traced(path, through)


def rayoptics(path):
    """Rays behind the last of some surfaces; see ``traced``."""
    from rayoptics.elem.profiles import Spherical
    from rayoptics.elem.surface import Circular, Surface
    from rayoptics.raytr.raytrace import trace_raw
    from rayoptics.raytr.traceerror import TraceError

    def through(rows, origin, direction):
        steps = np.diff(rows[:, 0], append=rows[-1, 0])
        sequence = [[Surface(), None, (np.eye(3), np.array([0.0, 0.0, rows[0, 0]])), rows[0, 3], 1]]
        for step, (_, curvature, rim, _, behind) in zip(steps, rows, strict=True):
            surface = Surface(profile=Spherical(c=curvature))
            surface.clear_apertures = [Circular(rim)] if rim < np.inf else []
            sequence.append([surface, None, (np.eye(3), np.array([0.0, 0.0, step])), behind, 1])
        settings = {"check_apertures": True, "intersect_obj": False, "pt_inside_fuzz": 0.0}
        ends = np.full((len(origin), 6), np.nan)
        for end, start, ahead in zip(ends, origin, direction, strict=True):
            try:
                point, unit, *_ = trace_raw(iter(sequence), start, ahead, 587.5618, **settings)[0][-1]
            except TraceError:
                continue
            end[:] = *point[:2], point[2] + rows[-1, 0], *unit
        return ends

    return traced(path, through)


def traced(path, through):
    """Points and directions of rays behind the last surface, (n, 6), NaN where they do not pass, of each bundle of an
    NPZ file: NAME_rows (z, curvature, rim, index before and behind), NAME_origin and NAME_direction, (n, 3).
    """
    with np.load(path) as file:
        names = [name.removesuffix("_rows") for name in file if name.endswith("_rows")]
        return {name: through(*(file[f"{name}_{end}"] for end in ("rows", "origin", "direction"))) for name in names}


if __name__ == "__main__":
    kind, path, output = sys.argv[1:]
    kinds = {"ouster": ouster, "velodyne": velodyne, "ply": ply, "open3d": open3d, "pcd": pcd, "las": las,
             "colmap": colmap, "coco": coco, "fisheyes": fisheyes,
             "optiland": optiland, "rayoptics": rayoptics}  # fmt: skip
    try:
        np.savez(output, **kinds[kind](path))
    except ModuleNotFoundError as error:
        sys.exit(f"MISSING {error.name}")
