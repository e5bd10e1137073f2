"""Programs that are not moved yet."""

from __future__ import annotations

from .parts.program import FileWriter, ProgramFiles


def row(name, files, marks="", reads="", export="", lost=""):
    """Return a program without its functions."""
    writer = FileWriter(export, "", "") if export else None
    return ProgramFiles(name, files, marks=marks, reads=reads, lost=lost, export=writer)


_ROWS = (
    row(
        "OpenCV", ".yml, .xml, .json of FileStorage, also .gz",
        "camera_matrix distortion_coefficients image_width image_height opencv_storage",
        "pinhole with 4, 5, 8, 12 or 14 coefficients, fisheye, omnidir; stereo pairs", "opencv",
        "of four coefficients without a model's name: which model they are of",
    ),
    row(
        "ROS", "CameraInfo as .yaml, also as echoed",
        "camera_matrix distortion_model rectification_matrix projection_matrix",
        "plumb_bob, rational_polynomial, equidistant; a region of interest", "ros", "poses; binning is not read",
    ),
    row(
        "COLMAP", "cameras.txt, cameras.bin; images.txt, images.bin",
        "CAMERA_ID MODEL WIDTH HEIGHT PARAMS PINHOLE SIMPLE_RADIAL", "all models", "colmap",
        "skew, tilt, the terms s2 and s4 of a thin prism",
    ),
    row(
        "nerfstudio", "transforms.json, of NeRF and instant-ngp, too",
        "frames transform_matrix camera_angle_x fl_x file_path camera_model",
        "OPENCV, PINHOLE, OPENCV_FISHEYE, FISHEYE624, EQUIRECTANGULAR, ORTHOPHOTO", "nerfstudio",
        "several camera models in one file; k4 to k6 of a pinhole",
    ),
    row(
        "Kalibr", "camchain.yaml", "camera_model distortion_model distortion_coeffs intrinsics resolution T_cn_cnm1",
        "pinhole with radtan, equidistant or fov, omni, eucm, ds", "kalibr",
        "skew; cameras that move against each other",
    ),
    row(
        "EuRoC", "sensor.yaml, of Kimera, too",
        "sensor_type T_BS rate_hz camera_model intrinsics distortion_coefficients",
        "pinhole with radial-tangential (4 or 5) or equidistant", "", "",
    ),
    row(
        "OKVIS", "its settings as .yaml", "cameras T_SC image_dimension focal_length principal_point distortion_type",
        "pinhole with radialtangential, radialtangential8 or equidistant", "", "",
    ),
    row(
        "VINS", "camodocal's .yaml, of VINS-Mono, VINS-Fusion and KITTI-360",
        "model_type projection_parameters distortion_parameters mirror_parameters",
        "PINHOLE, PINHOLE_FULL, MEI, KANNALA_BRANDT, SCARAMUZZA", "", "",
    ),
    row(
        "ORB-SLAM", "settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam as .yaml",
        "Camera.fx Camera.fy Camera.cx Camera.type Camera.fps",
        "PinHole, Rectified, KannalaBrandt8, perspective, fisheye", "", "stella_vslam's other models are refused",
    ),
    row(
        "Basalt", "calibration .json", "value0 intrinsics camera_type resolution T_imu_cam",
        "ds, eucm, ucm, kb4, fov, pinhole, pinhole-radtan8", "", "",
    ),
    row(
        "BOP", "camera.json, scene_camera.json", "cam_K depth_scale cam_R_w2c cam_t_w2c", "pinhole", "bop",
        "the size of the pictures, distortion, skew",
    ),
    row(
        "RealSense", "intrinsics as .json; Open3D's and NICE-SLAM's: fx, fy, cx, cy by names",
        "width height ppx ppy coeffs intrinsic_matrix", "pinhole, Brown-Conrady", "",
        "the inverse Brown-Conrady with coefficients is refused",
    ),
    row(
        "mrcal", ".cameramodel", "lensmodel intrinsics extrinsics imagersize",
        "PINHOLE, OPENCV4 to OPENCV12, STEREOGRAPHIC, LONLAT", "mrcal", "CAHVOR and splined models are refused",
    ),
    row(
        "Project Aria", "calibration .json, online_calibration.jsonl", "CameraCalibrations Label Projection Params",
        "FisheyeRadTanThinPrism, KannalaBrandtK3, Linear", "", "the size of the pictures",
    ),
    row(
        "NVIDIA (f-theta, Isaac Sim)", "DriveWorks rigs, NCore, NuRec, camera_params.json",
        "rig sensors properties ftheta polynomial reference_poly cameraModel",
        "f-theta, fisheyePolynomial, pinhole", "", "windshields are refused",
    ),
    row(
        "WoodScape", "calibration .json", "intrinsic cx_offset cy_offset poly_order radial_poly aspect_ratio",
        "radial_poly", "", "",
    ),
    row(
        "OpenSfM", "camera_models.json", "projection_type focal focal_x width height k1",
        "perspective, brown, radial, fisheye, fisheye_opencv, spherical", "", "poses; other projections are refused",
    ),
    row(
        "maplab", "ncamera .yaml of maplab and SVO", "cameras camera label image_height type T_B_C",
        "pinhole, unified-projection, with radial-tangential, rational, equidistant or fisheye", "", "",
    ),
    row(
        "HOT3D", "cameras of its clips as .json",
        "calibration projection_model_type projection_params T_device_from_camera",
        "FISHEYE624, PINHOLE", "", "",
    ),
    row(
        "Metashape", "calibrations, and cameras of projects, as .xml",
        "document chunk sensors sensor resolution adjusted",
        "frame, fisheye; slave cameras", "",
        "cameras that are not aligned; k4 of a frame camera, p3 and p4 are refused",
    ),
    row(
        "Meshroom", ".sfm of AliceVision", "intrinsicId pxFocalLength principalPoint distortionParams sensorWidth",
        "pinhole, radial1, radial3, brown, fisheye4, fisheye1", "",
        "views without a pose; anamorphic lenses are refused",
    ),
    row("Polycam", "keyframes' cameras as .json", "fx fy t_00 t_01 t_23 blur_score", "pinhole"),
    row("ARKitScenes", ".pincam; .traj", reads="pinhole"),
    row(
        "KITTI", "calib_cam_to_cam.txt, also perspective.txt of KITTI-360; calib.txt; poses .txt",
        "P0 P1 P2 P3 Tr", "pinholes as calibrated (K_02) and rectified (P_rect_02, P2), and their places", "kitti",
        "of calib.txt the size of the pictures; of poses lenses and times",
    ),
    row(
        "Gyroflow", "lens profiles as .json", "calib_dimension fisheye_params use_opencv_fisheye calibrator_version",
        "opencv_fisheye, opencv_standard", "", "stretched pictures and other models are refused",
    ),
    row(
        "OCamCalib", "calib_results.txt; the same as .json",
        "polynomial direct mapping affine polynomialC2W image_center",
        "OCam", "", "",
    ),
    row(
        "Velodyne", "calibrations of the ROS driver as .yaml",
        "lasers laser_id rot_correction vert_correction num_lasers",
        "lasers, with angles and offsets, as scanners", "",
        "when lasers fire, which is that of the device; corrections of ranges",
    ),
    row(
        "Ouster", "metadata .json of all firmware",
        "beam_altitude_angles beam_azimuth_angles lidar_mode beam_intrinsics lidar_intrinsics",
        "beams, their origins, columns and rate, as scanners", "", "sensors without a turning head are refused",
    ),
    row(
        "Hesai", "angle corrections .csv", "channel elevation azimuth", "channels, as scanners", "",
        "columns and times",
    ),
    row(
        "this add-on", "camera.json, report.json", "format cameras all_frames frames record settings", "every model",
        "json", "nothing",
    ),
    row(
        "camera_calibration (Schöps)", "intrinsics .yaml",
        "calibration_min_x calibration_max_x grid_width grid_height grid",
        "CentralGenericModel, NoncentralGenericModel", "", "",
    ),
    row(
        "ray tables",
        "ray maps as .npz; .npy or float32 .exr of directions, also with origins; .csv and .obj of a mesh of rays",
        reads="a ray for each pixel, or fewer", lost="pixel times",
    ),
    row(
        "NeRF", "transforms_train.json, _val and _test", export="nerf", lost="all lenses but centered pinholes"
    ),
    row("TUM", "trajectories .txt", export="tum", lost="lenses"),
    row("EuRoC trajectories", ".csv", export="euroc", lost="lenses"),
    row("STMaps", "pairs of .exr", export="stmap", lost="what is seen from two places; poses"),
    row("NumPy", ".npz with each pixel's ray", export="npz", lost="the formula: rays between pixels"),
)  # fmt: skip
ROWS = {row.name: row for row in _ROWS}
"""By name."""
