"""The programs whose files are read and written: one table for the menus, the refusals and the documentation."""

from __future__ import annotations

from typing import NamedTuple


class ProgramFiles(NamedTuple):
    """A program's files."""

    name: str
    files: str
    """Names of its files; how they are recognized is said in its module."""
    marks: str = ""
    """Words that its files have: a file of no known format is nearest to the program with most of them."""
    reads: str = ""
    """Lenses that are read, in the program's words; "" if none is."""
    export: str = ""
    """Key of the export that writes its files; "" without one."""
    lost: str = ""
    """What its files do not tell, or what is refused."""


PROGRAMS = (
    ProgramFiles(
        "OpenCV", ".yml, .xml, .json of FileStorage, also .gz",
        "camera_matrix distortion_coefficients image_width image_height opencv_storage",
        "pinhole with 4, 5, 8, 12 or 14 coefficients, fisheye, omnidir; stereo pairs", "opencv",
        "of four coefficients without a model's name: which model they are of",
    ),
    ProgramFiles(
        "ROS", "CameraInfo as .yaml, also as echoed",
        "camera_matrix distortion_model rectification_matrix projection_matrix",
        "plumb_bob, rational_polynomial, equidistant; a region of interest", "ros", "poses; binning is not read",
    ),
    ProgramFiles(
        "COLMAP", "cameras.txt, cameras.bin; images.txt, images.bin",
        "CAMERA_ID MODEL WIDTH HEIGHT PARAMS PINHOLE SIMPLE_RADIAL", "all models", "colmap",
        "skew, tilt, the terms s2 and s4 of a thin prism",
    ),
    ProgramFiles(
        "nerfstudio", "transforms.json, of NeRF and instant-ngp, too",
        "frames transform_matrix camera_angle_x fl_x file_path camera_model",
        "OPENCV, PINHOLE, OPENCV_FISHEYE, FISHEYE624, EQUIRECTANGULAR, ORTHOPHOTO", "nerfstudio",
        "several camera models in one file; k4 to k6 of a pinhole",
    ),
    ProgramFiles(
        "Kalibr", "camchain.yaml", "camera_model distortion_model distortion_coeffs intrinsics resolution T_cn_cnm1",
        "pinhole with radtan, equidistant or fov, omni, eucm, ds", "kalibr",
        "skew; cameras that move against each other",
    ),
    ProgramFiles(
        "EuRoC", "sensor.yaml, of Kimera, too",
        "sensor_type T_BS rate_hz camera_model intrinsics distortion_coefficients",
        "pinhole with radial-tangential (4 or 5) or equidistant", "", "",
    ),
    ProgramFiles(
        "OKVIS", "its settings as .yaml", "cameras T_SC image_dimension focal_length principal_point distortion_type",
        "pinhole with radialtangential, radialtangential8 or equidistant", "", "",
    ),
    ProgramFiles(
        "VINS", "camodocal's .yaml, of VINS-Mono, VINS-Fusion and KITTI-360",
        "model_type projection_parameters distortion_parameters mirror_parameters",
        "PINHOLE, PINHOLE_FULL, MEI, KANNALA_BRANDT, SCARAMUZZA", "", "",
    ),
    ProgramFiles(
        "ORB-SLAM", "settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam as .yaml",
        "Camera.fx Camera.fy Camera.cx Camera.type Camera.fps",
        "PinHole, Rectified, KannalaBrandt8, perspective, fisheye", "", "stella_vslam's other models are refused",
    ),
    ProgramFiles(
        "Basalt", "calibration .json", "value0 intrinsics camera_type resolution T_imu_cam",
        "ds, eucm, ucm, kb4, fov, pinhole, pinhole-radtan8", "", "",
    ),
    ProgramFiles(
        "BOP", "camera.json, scene_camera.json", "cam_K depth_scale cam_R_w2c cam_t_w2c", "pinhole", "bop",
        "the size of the pictures, distortion, skew",
    ),
    ProgramFiles(
        "RealSense", "intrinsics as .json; Open3D's and NICE-SLAM's: fx, fy, cx, cy by names",
        "width height ppx ppy coeffs intrinsic_matrix", "pinhole, Brown-Conrady", "",
        "the inverse Brown-Conrady with coefficients is refused",
    ),
    ProgramFiles(
        "mrcal", ".cameramodel", "lensmodel intrinsics extrinsics imagersize",
        "PINHOLE, OPENCV4 to OPENCV12, STEREOGRAPHIC, LONLAT", "mrcal", "CAHVOR and splined models are refused",
    ),
    ProgramFiles(
        "Project Aria", "calibration .json, online_calibration.jsonl", "CameraCalibrations Label Projection Params",
        "FisheyeRadTanThinPrism, KannalaBrandtK3, Linear", "", "the size of the pictures",
    ),
    ProgramFiles(
        "NVIDIA (f-theta, Isaac Sim)", "DriveWorks rigs, NCore, NuRec, camera_params.json",
        "rig sensors properties ftheta polynomial reference_poly cameraModel",
        "f-theta, fisheyePolynomial, pinhole", "", "windshields are refused",
    ),
    ProgramFiles(
        "WoodScape", "calibration .json", "intrinsic cx_offset cy_offset poly_order radial_poly aspect_ratio",
        "radial_poly", "", "",
    ),
    ProgramFiles(
        "OpenSfM", "camera_models.json", "projection_type focal focal_x width height k1",
        "perspective, brown, radial, fisheye, fisheye_opencv, spherical", "", "poses; other projections are refused",
    ),
    ProgramFiles(
        "maplab", "ncamera .yaml of maplab and SVO", "cameras camera label image_height type T_B_C",
        "pinhole, unified-projection, with radial-tangential, rational, equidistant or fisheye", "", "",
    ),
    ProgramFiles(
        "HOT3D", "cameras of its clips as .json",
        "calibration projection_model_type projection_params T_device_from_camera",
        "FISHEYE624, PINHOLE", "", "",
    ),
    ProgramFiles(
        "Metashape", "calibrations, and cameras of projects, as .xml",
        "document chunk sensors sensor resolution adjusted",
        "frame, fisheye; slave cameras", "",
        "cameras that are not aligned; k4 of a frame camera, p3 and p4 are refused",
    ),
    ProgramFiles(
        "Meshroom", ".sfm of AliceVision", "intrinsicId pxFocalLength principalPoint distortionParams sensorWidth",
        "pinhole, radial1, radial3, brown, fisheye4, fisheye1", "",
        "views without a pose; anamorphic lenses are refused",
    ),
    ProgramFiles("Polycam", "keyframes' cameras as .json", "fx fy t_00 t_01 t_23 blur_score", "pinhole"),
    ProgramFiles("ARKitScenes", ".pincam; .traj", reads="pinhole"),
    ProgramFiles(
        "KITTI", "calib_cam_to_cam.txt, also perspective.txt of KITTI-360; calib.txt; poses .txt",
        "P0 P1 P2 P3 Tr", "pinholes as calibrated (K_02) and rectified (P_rect_02, P2), and their places", "kitti",
        "of calib.txt the size of the pictures; of poses lenses and times",
    ),
    ProgramFiles(
        "Gyroflow", "lens profiles as .json", "calib_dimension fisheye_params use_opencv_fisheye calibrator_version",
        "opencv_fisheye, opencv_standard", "", "stretched pictures and other models are refused",
    ),
    ProgramFiles(
        "OCamCalib", "calib_results.txt; the same as .json",
        "polynomial direct mapping affine polynomialC2W image_center",
        "OCam", "", "",
    ),
    ProgramFiles(
        "Velodyne", "calibrations of the ROS driver as .yaml",
        "lasers laser_id rot_correction vert_correction num_lasers",
        "lasers, with angles and offsets, as scanners", "",
        "when lasers fire, which is that of the device; corrections of ranges",
    ),
    ProgramFiles(
        "Ouster", "metadata .json of all firmware",
        "beam_altitude_angles beam_azimuth_angles lidar_mode beam_intrinsics lidar_intrinsics",
        "beams, their origins, columns and rate, as scanners", "", "sensors without a turning head are refused",
    ),
    ProgramFiles(
        "Hesai", "angle corrections .csv", "channel elevation azimuth", "channels, as scanners", "",
        "columns and times",
    ),
    ProgramFiles(
        "this add-on", "camera.json, report.json", "format cameras all_frames frames record settings", "every model",
        "json", "nothing",
    ),
    ProgramFiles(
        "camera_calibration (Schöps)", "intrinsics .yaml",
        "calibration_min_x calibration_max_x grid_width grid_height grid",
        "CentralGenericModel, NoncentralGenericModel", "", "",
    ),
    ProgramFiles(
        "ray tables",
        "ray maps as .npz; .npy or float32 .exr of directions, also with origins; .csv and .obj of a mesh of rays",
        reads="a ray for each pixel, or fewer", lost="pixel times",
    ),
    ProgramFiles(
        "NeRF", "transforms_train.json, _val and _test", export="nerf", lost="all lenses but centered pinholes"
    ),
    ProgramFiles("TUM", "trajectories .txt", export="tum", lost="lenses"),
    ProgramFiles("EuRoC trajectories", ".csv", export="euroc", lost="lenses"),
    ProgramFiles("STMaps", "pairs of .exr", export="stmap", lost="what is seen from two places; poses"),
    ProgramFiles("NumPy", ".npz with each pixel's ray", export="npz", lost="the formula: rays between pixels"),
)  # fmt: skip
"""All programs, in the order in which messages name them."""

_names = [program.name for program in PROGRAMS if program.reads]
FILE_WRITERS = f"{', '.join(_names[:-1])} or {_names[-1]}"
"""The programs whose calibration files are read, in words."""
