"""Names from other libraries, and the names that they have here: they complete the messages on unknown names.

Each line of a table has what to use, and after <- the names that people try: OpenCV's, COLMAP's, Open3D's, PyTorch3D's,
trimesh's, Blender's and others. Case and underscores do not count, nor does a leading ``get``.
"""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches


def _folded(word: str) -> str:
    return word.lower().replace("_", "").replace("-", "").removeprefix("get")


def _table(text: str) -> dict[str, list[str]]:
    """Return what to use by name, in the order of the lines."""
    lines: dict[str, list[str]] = {}
    for use, _, names in (line.partition(" <- ") for line in text.strip().splitlines()):
        for name in names.split():
            lines.setdefault(_folded(name), []).append(use)
    return lines


FUNCTIONS = _table("""
mesh(vertices, faces), or mesh(object of trimesh) <- load_mesh read_mesh read_triangle_mesh load_obj load_ply load_objs
mesh(vertices, faces), or mesh(object of trimesh) <- TriangleMesh triangles from_trimesh trimesh icosphere from_open3d
mesh(vertices, faces) <- box cube create_box cylinder cone from_pytorch3d
spheres(centers, radii) <- sphere ball balls uv_sphere create_sphere
planes(centers, axes) <- plane ground floor quad
join(shapes, ...) <- merge concatenate concat combine union
camera("OPENCV_PINHOLE", size, fx=..., k1=...) <- from_opencv from_k from_matrix from_intrinsics camera_from_k k
camera("OPENCV_PINHOLE", size, fx=..., k1=...) <- PinholeCamera PinholeCameraIntrinsic pinhole intrinsics camera_matrix
camera("OPENCV_FISHEYE", size, fx=..., k1=...) <- fisheye FisheyeCamera FisheyeCameras kb4 kb8 kannala_brandt
camera("PERSP", size, lens=..., sensor_width=...) <- perspective PerspectiveCamera FoVPerspectiveCameras fov from_fov
camera("ORTHO", size, ortho_scale=...) <- orthographic OrthographicCamera FoVOrthographicCameras
camera(model, size, pose, clip_start=..., k1=...) <- near far znear zfar dist dist_coeffs distortion cameras
models() <- list_models camera_models available_models camera_model model
load_calibration(path) <- load_camera read_calibration load_intrinsics from_kalibr from_ros calibration
load_rig(path) <- load_cameras read_cameras read_model load_colmap from_colmap from_nerfstudio load_transforms rig
look_at(eye, target) <- lookat pose look_at_view_transform look_at_rotation
pose_from_opencv(matrix) <- extrinsics from_extrinsics from_w2c rodrigues
camera(...).project(points) <- project project_points world_to_pixel distort distort_points
camera(...).rays_at(x, y) <- unproject unproject_points backproject pixel_to_ray undistort_points undistort_point
camera(...).rays() <- rays generate_rays ray_directions
cast(camera, shapes, passes=...) <- depth depth_map normals flow optical_flow depth_to_points depth_to_point_cloud
cast(camera, shapes) <- render rasterize render_image
cast(camera, shapes), or cast_rays(origins, directions, shapes) <- raycast trace raytrace ray_trace raycaster
cast_rays(origins, directions, shapes) <- intersect intersects ray_intersect cast_ray closest_hit RaycastingScene
occluded(origins, targets, shapes) <- intersects_any test_occlusions occlusion shadow
visible(camera, shapes, points) <- is_visible visibility
scan(camera("SCANNER", size), shapes) <- lidar lidar_scan point_cloud scanner
export(camera, path, format="stmap") <- undistort rectify remap init_undistort_rectify_map undistort_image
export(cameras, path), or save_points(cloud, path) <- save write save_cameras to_colmap to_nerfstudio to_opencv
save_points(cloud, path) <- save_ply save_pcd write_ply to_ply write_point_cloud
camera_from_json(path) <- load_json from_json
top_down(images) <- flip flipud flip_y
fit(camera, model) <- calibrate calibrate_camera convert
read_scene(scene), or mesh(vertices, faces) <- load_scene from_blender
InputError <- error crc_error exception
camera_ray_caster.blender.cycles.to_cycles(scene) <- to_cycles
""")
"""What to use in place of a function that this package does not have."""

ATTRIBUTES = _table("""
rays_at(x, y) <- unproject unproject_points backproject pixel_to_ray pixel2ray image_to_world undistort_points ray
rays() <- generate_rays ray_directions ray_bundle
project(points) <- project_points world_to_pixel world2pixel world_to_image transform_points distort distort_points
crc.export(camera, path, format="stmap") <- undistort undistort_image rectify
crc.export(camera, path) <- save export write to_colmap to_opencv to_nerfstudio
crc.camera_to_json(camera) <- to_json to_dict as_dict
crc.cast(camera, shapes) <- render cast raycast trace depth
settings, or rays() for the angles <- fov fovx fovy hfov vfov xfov yfov field_of_view
clip_start <- near znear clip_near near_plane near_clip
clip_end <- far zfar clip_far far_plane far_clip
K, or numpy.linalg.inv(camera.K) <- k_inv inv_k
K <- k intrinsic_matrix intrinsics_matrix camera_matrix calibration_matrix projection_matrix kk
K and settings <- intrinsics intrinsic calibration
opencv_from_world <- extrinsics extrinsic extrinsic_matrix world_to_camera camera_from_world cam_from_world w2c rt view
opencv_from_world <- t_cw tcw view_matrix world_view_transform world_to_view_transform world_to_cam r t tvec translation
world_from_camera <- camera_to_world matrix_world c2w cam_to_world world_from_cam t_wc twc matrix transform
pose.eye <- position location center origin eye camera_center optical_center c
pose.basis <- rotation rotation_matrix r_c2w
settings <- dist dist_coeffs distortion distortion_coeffs distortion_params params d lens sensor_width sensor_size
width and height <- size resolution image_size img_size shape w h
settings["fx"], or K <- fx f focal focal_length fl_x
settings["fy"], or K <- fy fl_y
settings["cx"], or K <- cx principal_point
settings["cy"], or K <- cy
model.key <- type camera_type camera_model model_name
with_pose(pose) <- set_pose look_at move
with_settings(...) <- replace copy clone with_fov
crc.camera(model, size) of the other size <- resize rescale with_size downscale
motion, next and previous <- timeline
""")
"""What to use in place of an attribute that a camera does not have."""

OF_SHAPES = _table("""
motion, next and previous <- timeline
len(shapes) <- count n num_shapes
center <- centers position location
""")
"""What to use in place of an attribute that shapes do not have."""

WORDS = _table("""
fisheye_fov <- fov hfov vfov fov_x fov_y xfov yfov
fx, fy <- focal_length focal f
fx <- fov hfov fov_x xfov fl_x angle
fy <- vfov fov_y yfov fl_y
clip_start <- near znear near_plane clip_near near_clip
clip_end <- far zfar far_plane clip_far far_clip
fx, fy, cx, cy <- k intrinsics camera_matrix intrinsic_matrix
lens, sensor_width <- fov hfov vfov fov_x fov_y xfov yfov k intrinsics camera_matrix angle fx fl_x
lens <- focal_length focal f fx fy fl_x fl_y
cx, cy <- principal_point
cx <- px u0 ppx
cy <- py v0 ppy
shift_x, shift_y <- principal_point cx cy px py
k1, k2, p1, p2, k3 <- dist distortion dist_coeffs distortion_coeffs distortion_params d
k1, k2, k3, k4 <- dist distortion dist_coeffs distortion_coeffs distortion_params d
aperture_fstop <- f_stop f_number fnumber aperture
focus_distance <- focus focus_dist
sensor_width <- sensor_size
pixel_aspect_x, pixel_aspect_y <- aspect aspect_ratio pixel_aspect
time_mode <- shutter rolling_shutter
pose <- r t rt rvec tvec rotation translation position location look_at c2w transform_matrix matrix_world extrinsics
size <- width height w h resolution image_size img_size resolution_x resolution_y
scanner_device <- device
unified_xi <- xi
unified_alpha <- alpha
unified_beta <- beta
fov_omega <- omega
PERSP <- perspective thin_lens FoVPerspectiveCameras PerspectiveCameras dof
ORTHO <- orthographic parallel orthogonal OrthographicCameras
OPENCV_FISHEYE <- kb kb3 kb4 kb8 kannala_brandt kannala_brandt4 kannala_brandt8 fisheye equidistant radial_fisheye
OPENCV_FISHEYE <- simple_radial_fisheye
OPENCV_PINHOLE <- pinhole simple_pinhole simple_radial radial radtan brown brown_conrady opencv full_opencv plumb_bob
OPENCV_PINHOLE <- rational_polynomial rational
UCM <- mei omni unified cata
DOUBLE_SPHERE <- ds
EQUIRECTANGULAR <- erp panorama pano spherical equirect 360 latlong vr180
EQUIANGULAR_CUBEMAP_FACE <- cubemap cube cube_map eac
SCANNER <- lidar laser velodyne ouster
PUSHBROOM <- linescan line_scan rpc satellite
OMNIDIRECTIONAL_STEREO <- ods
OCAM <- scaramuzza omnidirectional ocamcalib
combined <- rgb rgba color image beauty alpha
albedo <- diffuse base_color diffuse_color
depth <- z range t t_hit inv_depth disparity
normal <- normals normal_map
position <- points xyz point_cloud
shape_index <- mask instance instance_id instances geometry_ids instance_index
object_index <- segmentation semantic semantics labels class category object_id
face_index <- primitive_id primitive_ids triangle_id
flow_forward <- flow optical_flow motion_vector motion vector speed
flow_hidden <- occlusion
valid <- hit
nerf <- blender nerf_synthetic
nerfstudio <- transforms instant_ngp
opencv <- yaml yml xml
stmap <- exr uvmap
""")
"""What is meant by a word for a model, setting, pass or format: the first line all of whose words are known."""


def nearest(word: str, known: Collection[str], likeness: float = 0.6) -> str:
    """Return the word of ``known`` that is spelled most like a word; "" if none is like it."""
    spellings = {name.lower(): name for name in known}
    return next((spellings[name] for name in get_close_matches(word.lower(), spellings, 1, likeness)), "")


def instead(word: str, table: dict[str, list[str]], known: Collection[str]) -> str:
    """Return what to use in place of a name that does not exist: by a table, or the nearest of the public names among
    ``known``, as the end of a message; "" if there is none.
    """
    public = [] if word.startswith("_") else [name for name in known if not name.startswith("_")]
    use = next(iter(table.get(_folded(word), ())), "") or nearest(word, public, 0.75)
    return f": use {use}" if use else ""


def meant(word: str, known: Collection[str]) -> str:
    """Return what is meant by a word of another library, one or several words of ``known``; "" if it is not listed."""
    return next((use for use in WORDS.get(_folded(word), ()) if {*use.split(", ")} <= {*known}), "")
