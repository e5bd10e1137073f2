"""Casts .blend files and compares seven passes with those of Cycles: compare.py FOLDER.

FOLDER has README.tsv (name, resolution, ...), NAME.blend and NAME.cycles.npz: depth, position, normal, uv, index and
``names``, rows from the bottom; Cycles' colors are rendered here. Pixels are compared that no edge of an object or of
the depth touches, unless the report names their object or a material of it. Exit status 1 if more than MOST of them
differ in any pass.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
CAST = ROOT / "scripts" / "cast.py"
sys.path.insert(0, str(ROOT))
from tests.blender.cycles.test_alpha import cycles  # noqa: E402

MOST = 0.002
"""Largest share of the pixels that may differ in a pass."""

PASSES = "depth,distance,position,normal,uv,shape_index,albedo"
NEAR, TURNED, MAPPED = 1e-3, 2.0, 2e-3
"""Largest differences: of depths and places over the distance, of normals in degrees, of u and v."""

COLORED = 0.02
"""Largest difference of colors."""

OPAQUE = "it is cast as opaque"
"""In the notes on materials that let Cycles' passes show what is behind, of which the colors here have none."""

JUMP = 0.02
"""Step from one pixel's depth to the next one's, over the depth, that is an edge."""


def main(folder: Path) -> int:
    """Compare all files of a folder, print a line each, and return the exit status."""
    worst = 0.0
    with open(folder / "README.tsv", newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table, delimiter="\t"):
            shares, excused = compared(folder, row["name"], row["resolution"])
            found = ", ".join(f"{name} {share:.2%}" for name, share in shares.items())
            print(f"compared: {row['name']}: {found}; {excused:.1%} of the pixels are of what the report names")
            worst = max(worst, *shares.values())
    return int(worst > MOST)


def compared(folder: Path, name: str, size: str) -> tuple[dict[str, float], float]:
    """Return the share of pixels that differ, by pass, and the share of those that the report names."""
    with tempfile.TemporaryDirectory() as out:
        words = [folder / f"{name}.blend", "--resolution", size, "--format", "NPZ", "--passes", PASSES, "--output", out]
        subprocess.run([sys.executable, CAST, *words], check=True, stdout=subprocess.DEVNULL)
        ours = dict(np.load(Path(out) / f"{name}.npz"))
        report = json.loads((Path(out) / "report.json").read_text(encoding="utf-8"))
    theirs = dict(np.load(folder / f"{name}.cycles.npz"))
    (layer, indices), *_ = report["indices"].items()
    ours = {key.removeprefix(f"{layer}."): array.astype(np.float64) for key, array in ours.items()}
    numbers = {label: int(number) for number, label in json.loads(str(theirs["names"])).items()}
    bpy.ops.wm.open_mainfile(filepath=str(folder / f"{name}.blend"), load_ui=False, use_scripts=False)
    remarks = [entry for entry in (*report["left_out"], *report["notes"]) if OPAQUE not in entry.get("note", "")]
    named = _objects_with({entry["name"] for entry in remarks})
    index, is_named = np.zeros((2, *ours["depth"].shape))
    for run in indices["shape_index"]:
        here = (ours["shape_index"] >= run["first"]) & (ours["shape_index"] < run["first"] + run["count"])
        index[here], is_named[here] = numbers.get(run["object"], -1), run["object"] in named
    hit = np.isfinite(ours["depth"]) & (ours["depth"] < 1e9)
    true_hit = (theirs["depth"] < 1e9) & (theirs["depth"] != 0) & (theirs["normal"] != 0).any(axis=-1)
    true_index = np.where(true_hit, theirs["index"], 0)
    for label in named & numbers.keys():
        is_named[true_index == numbers[label]] = True
    edge = _edges(index) | _edges(true_index) | _edges(ours["depth"], JUMP) | _edges(theirs["depth"], JUMP)
    where, both = ~edge & (is_named == 0), hit & true_hit
    with np.errstate(all="ignore"):
        off = {
            "depth": np.abs(ours["depth"] - theirs["depth"]) / np.abs(theirs["depth"]) > NEAR,
            "position": _length(ours["position"] - theirs["position"]) / ours["distance"] > NEAR,
            "normal": _angle(ours["normal"], theirs["normal"].astype(np.float64)) > TURNED,
            "uv": np.abs(ours["uv"] - theirs["uv"])[..., :2].max(axis=-1) > MAPPED,
            "index": index != true_index,
            "albedo": np.abs(ours["albedo"] - _colors(size)).max(axis=-1) > COLORED,
        }
    shares = {"hit": hit != true_hit} | {key: wrong & both for key, wrong in off.items()}
    total = max(int(where.sum()), 1)
    return {key: float((wrong & where).sum() / total) for key, wrong in shares.items()}, float((is_named > 0).mean())


def _colors(size: str) -> np.ndarray:
    """Return the colors of the surfaces of the open file in Cycles, (h, w, 3): without what a Principled BSDF adds by
    its specular reflection, with an alpha that is 0 or 1 as a hit is, and emission where there is nothing else.
    """
    scene = bpy.context.scene
    threshold = scene.view_layers[0].pass_alpha_threshold
    trees = [*(material.node_tree for material in bpy.data.materials if material.node_tree), *bpy.data.node_groups]
    for tree in trees:
        for node in tree.nodes:
            if node.type == "BSDF_PRINCIPLED":
                specular, alpha = node.inputs["Specular IOR Level"], node.inputs["Alpha"]
                for link in tuple(specular.links):
                    tree.links.remove(link)
                specular.default_value = 0.0
                for link in tuple(alpha.links):
                    is_hit = tree.nodes.new("ShaderNodeMath")
                    is_hit.operation, is_hit.inputs[1].default_value = "GREATER_THAN", threshold
                    tree.links.new(link.from_socket, is_hit.inputs[0])
                    tree.links.new(is_hit.outputs[0], alpha)
    render, lens = scene.render, scene.camera.data
    render.resolution_x, render.resolution_y = map(int, size.split("x"))
    render.resolution_percentage = 100
    render.use_compositing = render.use_sequencer = render.use_motion_blur = lens.dof.use_dof = False
    with tempfile.TemporaryDirectory() as folder:
        render.filepath, render.use_file_extension = f"{folder}/colors.exr", False
        *reflected, emission = cycles(scene, "Diffuse Color", "Glossy Color", "Transmission Color", "Emission")
    total = sum(reflected)
    return np.where(total.max(axis=-1, keepdims=True) > 0, total, emission)


def _objects_with(names: set[str]) -> set[str]:
    """Return these names, and those of the open file's objects that have a material of one of them."""
    return names | {
        item.name_full
        for item in bpy.data.objects
        if any(slot.material and slot.material.name_full in names for slot in item.material_slots)
    }


def _edges(values: np.ndarray, jump: float = 0.0) -> np.ndarray:
    """Return the pixels beside which a value differs, by more than ``jump`` of the lesser one."""
    values = np.where(np.isfinite(values) & (values < 1e9), values, 1e10)
    around = np.pad(values, 1, mode="edge")
    rows, columns = values.shape
    found = np.zeros(values.shape, bool)
    for y in range(3):
        for x in range(3):
            other = around[y : y + rows, x : x + columns]
            found |= np.abs(other - values) > jump * np.minimum(other, values)
    return found


def _length(vector: np.ndarray) -> np.ndarray:
    return np.sqrt((vector * vector).sum(axis=-1))


def _angle(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the angle between vectors of any length, degrees."""
    cosine = (one * other).sum(axis=-1) / (_length(one) * _length(other))
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
