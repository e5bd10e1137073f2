"""Models of BOP's objects, from the file of a set."""

import json

import cv2
import numpy as np
import pytest

from .running import left, refused

WORDS = "--frames", "1:2", "--passes", "depth,shape_index", "--annotations", "--format", "npz"


@pytest.fixture
def made(command, blender, scene, tmp_path):
    """A set of a sphere, a wedge without symmetry and a square."""
    mesh = blender.data.meshes.new("wedge")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)], [], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    wedge = blender.data.objects.new("Wedge", mesh)
    blender.context.scene.collection.objects.link(wedge)
    wedge.location, wedge.rotation_euler, wedge.scale = (1, 0.5, 0), (0.3, -0.2, 0.7), (0.5, 0.4, 0.3)
    blender.ops.mesh.primitive_plane_add(size=4, location=(0, 0, -2))
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert command("cast", scene, *WORDS, "--output", tmp_path / "set").returncode == 0
    return tmp_path / "set"


def exported(command, made, *words):
    return command("export", made, "--format", "bop-scenes", *words, "--output", made.parent / "bop")


VERTEX = np.dtype([("place", "<f4", 3), ("normal", "<f4", 3), ("color", "u1", 3)])


def read(path):
    """Vertices, triangles and normals of a binary PLY."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    counts = [int(line.split()[-1]) for line in head.decode().splitlines() if line.startswith("element")]
    vertices = np.frombuffer(body, VERTEX, counts[0])
    faces = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts[1], VERTEX.itemsize * counts[0])
    assert (faces["n"] == 3).all()
    assert len(body) == VERTEX.itemsize * counts[0] + 13 * counts[1]
    return vertices["place"].astype(np.float64), faces["v"], vertices["normal"].astype(np.float64)


def test_models_stand_where_blender_has_their_objects(command, blender, scene, made):
    done = exported(command, made, "--models", scene)
    assert (done.returncode, done.stderr) == (0, "")
    models = made.parent / "bop" / "models"
    assert left(models) == ["models_info.json", *(f"obj_00000{k}.ply" for k in (1, 2, 3))]
    info = json.loads((models / "models_info.json").read_text())
    numbers = {entry["name"]: int(key) for key, entry in info.items()}
    truth = json.loads((made.parent / "bop" / "test" / "000000" / "scene_gt.json").read_text())["2"]
    camera = json.loads((made.parent / "bop" / "test" / "000000" / "scene_camera.json").read_text())["2"]
    to_camera = np.eye(4)
    to_camera[:3, :3], to_camera[:3, 3] = np.reshape(camera["cam_R_w2c"], (3, 3)), camera["cam_t_w2c"]
    for item in (blender.data.objects[name] for name in ("Wedge", "Sphere")):
        number = numbers[item.data.name]
        vertices, triangles, normals = read(models / f"obj_{number:06}.ply")
        (entry,) = (entry for entry in truth if entry["obj_id"] == number)
        seen = vertices @ np.reshape(entry["cam_R_m2c"], (3, 3)).T + entry["cam_t_m2c"]
        a, b, c = np.moveaxis(vertices[triangles], 1, 0)
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6e9
        if item.name == "Wedge":
            world = np.array([(*(item.matrix_world @ vertex.co), 1) for vertex in item.data.vertices]) * (
                1e3,
                1e3,
                1e3,
                1,
            )
            assert np.abs(seen - (world @ to_camera.T)[:, :3]).max() < 1e-3  # millimeters: float32
            assert volume == pytest.approx(0.06)
            far = max(np.linalg.norm(p - q) for p in vertices for q in vertices)
            assert not [key for key in info[str(number)] if "symmetries" in key]
        else:
            assert np.abs(np.linalg.norm(vertices, axis=1) - 1000).max() < 3e-3  # Blender's vertices are float32
            assert volume == pytest.approx(4 / 3 * np.pi, rel=0.03)  # of 32 by 16 faces
            assert 2 * len(vertices) - 4 == len(triangles)  # closed
            assert np.abs(normals - vertices / 1000).max() < 0.02
            assert len(info[str(number)]["symmetries_continuous"]) == 3
            far = 2000
        assert far * (1 - 1e-3) <= info[str(number)]["diameter"] <= far * (1 + 1e-6)


def test_depths_and_masks_are_of_the_models(command, scene, made):
    done = exported(command, made, "--models", scene)
    assert "cast anew, with meshes as meshes" in done.stdout
    folder = made.parent / "bop" / "test" / "000000"
    truth, camera, facts = (json.loads((folder / f"scene_{name}.json").read_text())["1"]
                            for name in ("gt", "camera", "gt_info"))  # fmt: skip
    models = json.loads((made.parent / "bop" / "models" / "models_info.json").read_text())
    (k,) = (k for k, entry in enumerate(truth) if models[str(entry["obj_id"])]["name"] == "Sphere")
    depth = cv2.imread(str(folder / "depth" / "000001.png"), cv2.IMREAD_UNCHANGED) * camera["depth_scale"]
    seen = cv2.imread(str(folder / "mask_visib" / f"000001_{k:06}.png"), cv2.IMREAD_UNCHANGED) > 0
    assert seen.sum() == facts[k]["px_count_visib"] > 50
    row, column = np.nonzero(seen)
    rays = np.linalg.inv(np.reshape(camera["cam_K"], (3, 3))) @ (column, row, np.ones(len(row)))
    points = ((rays * depth[seen]).T - truth[k]["cam_t_m2c"]) @ np.reshape(truth[k]["cam_R_m2c"], (3, 3))
    vertices, triangles, _ = read(made.parent / "bop" / "models" / f"obj_{truth[k]['obj_id']:06}.ply")
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    away = (points @ normal.T - (normal * a).sum(axis=1)).max(axis=1)  # of a convex body
    assert np.abs(away).max() < camera["depth_scale"]  # millimeters; the exact sphere is up to 9.6 away
    report = json.loads((made / "small_0001.json").read_text() if (made / "small_0001.json").is_file() else
                        (made / "report_0001.json").read_text())  # fmt: skip
    assert any("the exact shape is up to 0.96% of its radius away from the mesh" in note for note in report["noted"])


@pytest.mark.cases(1)
@pytest.mark.parametrize("case", ["gone", "size", "no file", "format"])
def test_another_file_than_that_of_the_set_is_refused(command, blender, scene, made, case):
    words, message = ("--models", scene), "has no shape of 'Wedge': give the file that the set is of"
    if case == "gone":
        blender.data.objects.remove(blender.data.objects["Wedge"])
    elif case == "size":
        blender.data.objects["Wedge"].scale *= 2
        message = "'Wedge' is of another size in the file of --models"
    elif case == "no file":
        words, message = ("--models", made / "none.blend"), "none.blend"
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    if case == "format":
        message = "--models applies to --format bop-scenes only"
        done = command("export", made, "--format", "masks", *words, "--output", made.parent / "bop")
    else:
        done = exported(command, made, *words)
    assert message in refused(done)
    assert not (made.parent / "bop").exists()
