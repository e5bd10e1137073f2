"""A program is one file and one word: a toy is added to a copy of the package, and is everywhere."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import camera_ray_caster as crc

TOY = Path(__file__).with_name("lens_cards.py")
PACKAGE = Path(crc.__file__).parent
RUN = """
import json, sys
from pathlib import Path
import camera_ray_caster as crc
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.programs import READ, PLACED
sys.path.insert(0, sys.argv[2])
from make import pages

folder = Path(sys.argv[1])
pose = crc.look_at((1, 2, 3), (0, 0, 0))
camera = crc.camera("OPENCV_PINHOLE", (64, 48), pose, fx=60.0, name="left")
paths, _ = crc.export(camera, folder / "out", "cards")
(folder / "odd.txt").write_text("A text of nobody")
refusals = []
no = crc.camera("ORTHO", (4, 3))
for call in (lambda: crc.load_calibration(folder / "odd.txt"), lambda: crc.export(no, folder / "no", "cards")):
    try:
        call()
    except crc.InputError as error:
        refusals.append(str(error))
print(json.dumps({
    "table": pages.files(), "read": READ, "placed": PLACED, "help": crc.export.__doc__, "refusals": refusals,
    "menu": [[format.key, format.label, format.description] for format in EXPORT_FORMATS],
    "rays": bool(abs(crc.load_calibration(paths[0]).rays().directions - camera.rays().directions).max() < 1e-12),
    "rig": {name: camera.pose.eye.tolist() for name, camera in crc.load_rig(paths[0]).items()},
}))
"""


def test_a_toy_is_in_help_refusals_menu_and_table(tmp_path):
    copy = tmp_path / "addon" / "camera_ray_caster"
    shutil.copytree(PACKAGE / "core", copy / "core", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("__init__.py", "blender_manifest.toml"):
        shutil.copy(PACKAGE / name, copy)
    shutil.copy(TOY, copy / "core" / "programs")
    table = copy / "core" / "programs" / "__init__.py"
    text = table.read_text().replace("    maplab,\n", "    lens_cards,\n    maplab,\n")
    table.write_text(text.replace("MODULES = (", "MODULES = (\n    lens_cards,"))
    (tmp_path / "run.py").write_text(RUN)
    scripts = PACKAGE.parents[1] / "scripts"
    done = subprocess.run(
        [sys.executable, tmp_path / "run.py", tmp_path, scripts],
        env={"PYTHONPATH": str(copy.parent)},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    facts = json.loads(done.stdout)
    row = "| Lens Cards | lens_cards.txt | pinholes | `cards`: lens_cards.txt: pinholes and poses | distortion |\n"
    assert row in facts["table"]
    assert ["cards", "Lens Cards", "lens_cards.txt: pinholes and poses"] in facts["menu"]
    assert '"cards"' in facts["help"]
    assert facts["read"].startswith("Lens Cards, OpenCV")
    assert facts["placed"].startswith("Lens Cards")
    unknown, refused = facts["refusals"]
    assert "of no format that is read: these are Lens Cards, OpenCV" in unknown
    assert "Lens Cards cannot represent the Orthographic of camera 'Camera': choose one of" in refused
    assert facts["rays"]
    assert facts["rig"] == {"left": [1, 2, 3]}
