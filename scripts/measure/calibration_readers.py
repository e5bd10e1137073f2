"""Compare cameras read from calibration files with the files' own programs: largest pixel distance of 10,000 points.

Each file is read by this project and by its format's own reader, and both project points all over the picture. COLMAP's
and OpenCV's readers are compared in the tests. A reader that is not installed is named. mrcal needs numpysane and
SciPy, and nerfbaselines needs OpenCV and Pillow; install both with --no-deps. NCore is the package nvidia-ncore, with
PyTorch. image_geometry is Debian's python3-image-geometry; it cannot project to raw pixels, so it rectifies our pixels.
"""

import json
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from arguments import Parser

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT)]

COUNT = 10_000
WIDTH, HEIGHT = 640, 480
FRAME = {"resolution_x": WIDTH, "resolution_y": HEIGHT}
K = 401.25, 398.5, 322.75, 238.25
BROWN = -0.12, 0.03, 1e-3, -2e-3, 4e-3, 0.01, -2e-3, 3e-4, 1e-3, -5e-4, -2e-3, 3e-4
EQUIDISTANT = -0.03, 4e-3, -1e-3, 2e-4


def mrcal_files():
    """Yield (name, our model, file suffix, text of the file, mrcal's projection) of each lens model."""
    import mrcal

    for name, key, terms in (
        *((f"OPENCV{count}", "OPENCV_PINHOLE", BROWN[:count]) for count in (4, 5, 8, 12)),
        ("PINHOLE", "OPENCV_PINHOLE", ()),
        ("STEREOGRAPHIC", "UCM", ()),
    ):
        text = f"{{'lensmodel': 'LENSMODEL_{name}', 'intrinsics': {[*K, *terms]}, "
        text += f"'extrinsics': [0,0,0,0,0,0], 'imagersize': [{WIDTH}, {HEIGHT}]}}"

        def project(points, path):
            return mrcal.project(points, *mrcal.cameramodel(path).intrinsics()) + 0.5

        yield f"mrcal {name}", key, ".cameramodel", text, project


def nerfstudio_files():
    """Yield the same for transforms.json, with nerfbaselines' projection."""
    from nerfbaselines import cameras
    from nerfbaselines.datasets.nerfstudio import load_nerfstudio_dataset
    from PIL import Image

    for name, key, terms in (
        ("OPENCV", "OPENCV_PINHOLE", dict(zip(("k1", "k2", "p1", "p2"), BROWN, strict=False))),
        ("OPENCV_FISHEYE", "OPENCV_FISHEYE", dict(zip(("k1", "k2", "k3", "k4"), EQUIDISTANT, strict=True))),
    ):
        lens = dict(zip(("fl_x", "fl_y", "cx", "cy"), K, strict=True)) | {"w": WIDTH, "h": HEIGHT, **terms}
        frame = {"file_path": "a.png", "transform_matrix": np.eye(4).tolist(), **lens}
        text = json.dumps({"camera_model": name, "frames": [frame, frame | {"file_path": "b.png"}]})

        def project(points, path):
            for image in ("a.png", "b.png"):  # nerfbaselines opens them
                Image.new("L", (WIDTH, HEIGHT)).save(Path(path).parent / image)
            camera = load_nerfstudio_dataset(str(Path(path).parent), "train", train_split_fraction=1.0)["cameras"][0]
            still = camera.replace(poses=np.eye(4)[:3].astype(np.float64))
            return cameras.project(still[None], points[None])[0]

        yield f"nerfbaselines {name}", key, "transforms.json", text, project


def ncore_files():
    """Yield the same for f-theta cameras, with the projection of NVIDIA's NCore, which also writes the file."""
    import torch
    from ncore.data import FThetaCameraModelParameters, ShutterType
    from ncore.sensors import FThetaCameraModel

    reference = FThetaCameraModelParameters.PolynomialType
    for kind in (reference.ANGLE_TO_PIXELDIST, reference.PIXELDIST_TO_ANGLE):
        parameters = FThetaCameraModelParameters(
            resolution=np.array([WIDTH, HEIGHT], np.uint64), shutter_type=ShutterType.GLOBAL,
            external_distortion_parameters=None, principal_point=np.float32(K[2:]) - np.float32(0.5),
            reference_poly=kind, pixeldist_to_angle_poly=np.float32([0, 0.0033, 1e-7, -2e-10, 1e-13, 0]),
            angle_to_pixeldist_poly=np.float32([0, 301.5, 2.25, -7.5, 0.125, 0]), max_angle=1.75,
            linear_cde=np.float32([1.0005, 2e-4, -1e-4]),
        )  # fmt: skip

        def project(points, path, parameters=parameters):
            model = FThetaCameraModel(parameters, device="cpu", dtype=torch.float64, newton_iterations=20)
            return model.camera_rays_to_image_points(torch.from_numpy(points)).image_points.numpy()

        yield f"NCore {kind.name}", "FTHETA", ".json", json.dumps(parameters.to_dict()), project


def ros_files():
    """Yield the same for ROS' CameraInfo, but with image_geometry's camera, which rectifies pixels."""
    from image_geometry import PinholeCameraModel

    for name, terms in (("plumb_bob", BROWN[:5]), ("rational_polynomial", BROWN[:8])):
        fx, fy, cx, cy = K
        matrix = [fx, 0, cx, 0, fy, cy, 0, 0, 1]
        text = f"image_width: {WIDTH}\nimage_height: {HEIGHT}\ndistortion_model: {name}\n"
        text += f"camera_matrix:\n  rows: 3\n  cols: 3\n  data: {matrix}\n"
        text += f"distortion_coefficients:\n  rows: 1\n  cols: {len(terms)}\n  data: {list(terms)}\n"
        camera_model = PinholeCameraModel()
        camera_model.fromCameraInfo(SimpleNamespace(
            K=matrix, D=list(terms), R=np.eye(3).ravel(), P=[fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0], width=WIDTH,
            height=HEIGHT, binning_x=0, binning_y=0, header=SimpleNamespace(frame_id="", stamp=0),
            roi=SimpleNamespace(x_offset=0, y_offset=0, height=0, width=0, do_rectify=False),
        ))  # fmt: skip
        yield f"image_geometry {name}", "OPENCV_PINHOLE", "ros.yaml", text, camera_model


def points_before(cam) -> np.ndarray:
    """Return points in OpenCV's camera frame on rays through random positions in the picture."""
    random = np.random.default_rng(1)
    directions = cam.rays_at(*random.uniform((0, 0), (WIDTH, HEIGHT), (COUNT, 2)).T).directions
    return directions * random.uniform(0.5, 50, (COUNT, 1)) * (1, -1, -1)


def worst(key: str, suffix: str, text: str, other) -> float:
    """Return the largest distance in pixels between another program's projections and ours."""
    from tests.core.cameras.model_examples import camera

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / (suffix if suffix[0] != "." else f"lens{suffix}")
        path.write_text(text)
        cam = camera(key, FRAME | {"calibration_file": str(path)})
        points = points_before(cam)
        ours = cam.project(points * (1, -1, -1)) * (1, -1) + (0, HEIGHT)
        if callable(other):
            return float(np.abs(other(points, str(path)) - ours).max())
        rectified = np.array([other.rectifyPoint(pixel - 0.5) for pixel in ours])
        return float(np.abs(rectified - [other.project3dToPixel(point) for point in points]).max())


def main() -> int:
    """Print a line for each reader and lens model; return the exit status."""
    Parser(prog="calibration_readers.py", description=__doc__.splitlines()[0]).parse_args()
    for files in (mrcal_files, nerfstudio_files, ncore_files, ros_files):
        try:
            for name, *case in files():
                print(f"{name:36} {worst(*case):.1e}", flush=True)
        except ModuleNotFoundError as missing:
            print(f"{files.__name__}: {missing}")
    return 0
