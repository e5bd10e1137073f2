"""Compare all passes of all example scenes, bit for bit, here and at another commit."""

from __future__ import annotations

import json
import subprocess
import sys
from hashlib import sha256
from pathlib import Path

from .against import ROOT, checked_out

SCENES = ROOT / "blend_scenes"


def run(commit: str) -> list[dict]:
    """Print and return which passes of the example scenes differ from those of a commit. Raises LookupError if there is
    no such commit.
    """
    with checked_out(commit) as there:
        before, here = _hashes(there), _hashes(ROOT)
    rows = []
    for scene, passes in here.items():
        shared = passes.keys() & before.get(scene, {}).keys()
        differ = sorted(name for name in shared if passes[name] != before[scene][name])
        rows.append({"name": scene, "compared": len(shared), "differ": differ})
        print(f"  {scene:34}{len(shared):4} passes, {len(differ)} differ: {', '.join(differ)}".rstrip(": "))
    return rows


def _hashes(root: Path) -> dict[str, dict[str, str]]:
    """Return the hashes of the passes, by scene, cast with the add-on of a folder."""
    words = [sys.executable, "-c", "from measure import same_pictures; same_pictures.tell()", str(root)]
    done = subprocess.run(words, cwd=ROOT / "scripts", stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


def tell() -> None:
    """Print the hashes with the add-on of a folder, of all passes that a scene can have: no flow to frames that are
    refused, and no areas of the pixels of scanners.
    """
    sys.path[:0] = [str(Path(sys.argv[1]) / "addon")]
    import bpy

    import camera_ray_caster as crc
    from camera_ray_caster.core.casting.passes import PASSES

    crc.register()
    hashes = {}
    for path in sorted(SCENES.glob("*.blend")):
        bpy.ops.wm.open_mainfile(filepath=str(path))
        still = [name for name in PASSES if not name.startswith("flow")]
        for passes in (list(PASSES), still, [name for name in still if name not in ("solid_angle", "footprint")]):
            try:
                images = crc.cast(crc.read_scene(bpy.context.scene, passes=passes), passes=passes)
            except crc.InputError:
                continue
            hashes[path.stem] = {name: sha256(image.tobytes()).hexdigest() for name, image in images.items()}
            break
    print(json.dumps(hashes))
