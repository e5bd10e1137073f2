"""A rig of four cameras from files of four kinds, cast into a data set, and read by others' libraries."""

import json

import numpy as np
import pytest

from ..scripts.running import ROOT, script

pytestmark = pytest.mark.full

LENSES = (
    ((75.3, 75.1, 79.6, 59.3), (0.02, -0.004, 0.001, 0.0)),
    ((73.2, 73.4, 80.2, 60.1), (0.015, 0.003, -0.002, 0.0)),
)
COSINE, SINE = np.cos(0.1), np.sin(0.1)
BESIDE = np.array(((COSINE, 0, SINE, -0.6), (0, 1, 0, 0.02), (-SINE, 0, COSINE, 0.03), (0, 0, 0, 1)))
IN_BODY = np.array(((1, 0, 0, 0.3), (0, 1, 0, 0.1), (0, 0, 1, 0), (0, 0, 0, 1.0)))
PANORAMA = np.array(((1, 0, 0, 0.0), (0, -1, 0, -0.2), (0, 0, -1, 0), (0, 0, 0, 1)))  # y up, z behind
FRAMES = 20
PLACES = np.linspace((0.0, -6.0, 2.0), (0.6, -5.0, 2.4), FRAMES)
TURNS = np.linspace((-1, 0, 0, 1), (-0.7, 0, 0.1, 0.7), FRAMES)  # x, y, z, w
PASSES = "combined,depth,distance,position,normal,shape_index,distance_bound,position_bound,normal_bound"
BLENDER = 2e-7
"""What Blender's float32 may be off, in radians or units at a unit's length: turns of the body and of the camera."""


def kalibr():
    """A camchain of two fisheyes."""
    lines = []
    for k, (lens, coefficients) in enumerate(LENSES):
        lines += [f"cam{k}:", "  camera_model: pinhole", "  distortion_model: equidistant", "  resolution: [160, 120]",
                  f"  intrinsics: {list(lens)}", f"  distortion_coeffs: {list(coefficients)}"]  # fmt: skip
    return "\n".join([*lines, f"  T_cn_cnm1: {BESIDE.tolist()}\n"])


def euroc():
    """A sensor.yaml of a pinhole."""
    return (
        f"sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: {IN_BODY.ravel().tolist()}\nrate_hz: 24\n"
        "resolution: [160, 120]\ncamera_model: pinhole\nintrinsics: [110.2, 110.4, 80.1, 59.7]\n"
        "distortion_model: radial-tangential\ndistortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n"
    )


def nerfstudio():
    """A transforms.json of a panorama."""
    frame = {"file_path": "pano_0001.png", "w": 160, "h": 80, "transform_matrix": PANORAMA.tolist()}
    return json.dumps({"camera_model": "EQUIRECTANGULAR", "frames": [frame]})


def tum():
    """The body's way, at 24 frames a second."""
    poses = np.hstack((PLACES, TURNS)).tolist()
    return "".join(f"{k / 24:.9f} {' '.join(map(repr, pose))}\n" for k, pose in enumerate(poses))


def bodies():
    """The body's matrix in each frame, by the formula of quaternions."""
    for location, turn in zip(PLACES, TURNS, strict=True):
        x, y, z, w = turn / np.linalg.norm(turn)
        matrix = np.eye(4)
        matrix[:3, 3] = location
        matrix[:3, :3] = (
            (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
        )
        yield matrix


def length(vectors):
    return np.linalg.norm(vectors, axis=-1)


def consistent(there, points, passes, pixels, eye):
    """Which points another view shows, of those that it cannot but show.

    These lie between four pixels of their own shape, and face the eye. Two points of a surface, one with the normal n,
    are n · d apart from its tangent plane: at most κ |d|² / 2, if normals turn by at most κ a length. κ |d| is taken
    from the two normals: exactly what a plane and a sphere have, and twice that where the curvature changes.
    """
    height, width = there["shape_index"].shape
    column, row = np.floor(pixels).astype(int).T  # pixels have their centers at whole numbers, row 0 is at the top
    facing = ((eye - points) * passes["normal"]).sum(axis=-1) > 0
    inside = (column >= 0) & (column < width - 1) & (row >= 0) & (row < height - 1) & facing
    shown, right = inside.copy(), np.ones_like(inside)
    column, row = np.where(inside, column, 0), np.where(inside, row, 0)
    for k in range(4):
        beside = {name: values[row + k // 2, column + k % 2] for name, values in there.items()}
        shown &= beside["shape_index"] == passes["shape_index"]
        way = points - beside["position"]
        rounding = passes["position_bound"] + beside["position_bound"] + BLENDER * (1 + length(points - eye))
        rounding += (passes["normal_bound"] + beside["normal_bound"] + BLENDER) * length(way)
        bend = length(passes["normal"] - beside["normal"]) * length(way)
        right &= np.abs((way * beside["normal"]).sum(axis=-1)) <= bend + rounding
    return right[shown]


def test_a_rig_from_files_is_a_data_set_that_others_read(read, tmp_path):
    files = {"chain.yaml": kalibr(), "sensor.yaml": euroc(), "transforms.json": nerfstudio(), "path.txt": tum()}
    for name, content in files.items():
        (tmp_path / name).write_text(content)
    folder, model = tmp_path / "set", tmp_path / "model"
    rig = [tmp_path / name for name in files]
    done = script("cast", ROOT / "blend_scenes" / "spheres_and_planes.blend", "--rig", *rig, "--frames", f"1:{FRAMES}",
                   "--dataset", "--annotations", "--points", "ply", "--points-axes", "world", "--passes", PASSES,
                   "--output", folder)  # fmt: skip
    assert done.returncode == 0, done.stderr
    done = script("export", folder, "--format", "colmap-scene", "--points", 2000, "--output", model)
    assert done.returncode == 0, done.stderr

    views = {}  # rows from the top
    for path in folder.glob("*_00??.npz"):
        with np.load(path) as arrays:
            views[path.stem] = {name: np.asarray(arrays[name][::-1], float) for name in arrays}
    assert len(views) == 4 * FRAMES

    sparse = read("colmap", model / "sparse" / "0")
    names = [name.removesuffix(".png") for name in sparse["name"]]
    poses, lenses = dict(zip(names, sparse["pose"], strict=True)), dict(zip(names, sparse["lens"], strict=True))
    assert set(poses) == set(views)
    assert sparse["apart"].max() < 110 * BLENDER  # pixels a radian, of the longest lens
    (front,) = {name.rpartition("_")[0] for name in names if lenses[name] == "PINHOLE"}
    flipped = np.diag((1.0, -1, -1, 1))
    mounted = {"cam0": np.eye(4), "cam1": np.linalg.inv(BESIDE), front: IN_BODY, "pano": PANORAMA @ flipped}
    for frame, body in enumerate(bodies(), 1):
        for name, pose in mounted.items():
            expected = np.linalg.inv(body @ pose)[:3]
            assert np.abs(poses[f"{name}_{frame:04}"] - expected).max() < 10 * BLENDER  # from the origin

    masks = read("coco", folder / "annotations.json")
    for name, view in views.items():
        np.testing.assert_array_equal(masks[f"{name}.png"], view["shape_index"])

    for name, view in ((name, view) for name, view in views.items() if name.endswith(f"_{FRAMES:04}")):
        cloud = read("open3d", folder / f"{name}.ply")
        row, column = view["depth"].shape[0] - 1 - cloud["ring"].astype(int), cloud["column"].astype(int)
        assert len(set(zip(row, column, strict=True))) == np.isfinite(view["distance"]).sum() == len(row)
        places = np.stack([cloud[axis] for axis in "xyz"], axis=-1)
        assert (length(places - view["position"][row, column]) <= 2 * view["position_bound"][row, column]).all()

    pairs = [[f"cam{k}_{frame:04}" for k in (0, 1)] for frame in range(1, FRAMES + 1)]
    check_fisheyes(read, tmp_path / "given.npz", [([views[name] for name in pair], [poses[name] for name in pair])
                                                  for pair in pairs])  # fmt: skip


def check_fisheyes(read, path, pairs):
    """Depths of a fisheye are where its own positions are, and where the other one sees them; wrong ones are not."""
    (K, D), (other_K, other_D) = ((((fx, 0, cx), (0, fy, cy), (0, 0, 1)), D) for (fx, fy, cx, cy), D in LENSES)
    turns = [other[:, :3] @ pose[:, :3].T for _, (pose, other) in pairs]
    shifts = [other[:, 3] - turn @ pose[:, 3] for turn, (_, (pose, other)) in zip(turns, pairs, strict=True)]
    depths = np.array([view["depth"] for (view, _), _ in pairs])
    hits = np.isfinite(depths)
    shares = []
    for scale in (1.0, 1.0001):
        np.savez(path, depth=np.where(hits, depths, 1) * scale, K=K, D=D, turn=turns, shift=shifts, other_K=other_K,
                 other_D=other_D)  # fmt: skip
        read_back = read("fisheyes", path)
        for k, ((view, there), (_, other)) in enumerate(pairs):
            of_pixels = {name: values[hits[k]] for name, values in view.items()}
            seen = {name: values[k][hits[k].ravel()] for name, values in read_back.items()}
            points = (seen["points"] - other[:, 3]) @ other[:, :3]
            if scale == 1:
                bound = of_pixels["position_bound"] + of_pixels["distance_bound"]
                bound += BLENDER * (1 + of_pixels["distance"])
                assert (length(points - of_pixels["position"]) <= bound).all()
            right = consistent(there, points, of_pixels, seen["pixels"], -other[:, :3].T @ other[:, 3])
            assert len(right) > 3000
            shares.append(right.mean())
    assert min(shares[:FRAMES]) >= 0.99
    assert max(shares[FRAMES:]) < 0.5  # the bounds are narrow: a ten-thousandth of a depth is seen
