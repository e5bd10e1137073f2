"""What a set takes does not grow with its pictures: 50 and 250 pictures, stubs of 24 x 18 pixels, have one peak; all
hostile inputs have 6,400.
"""

import json
import os
import subprocess
import sys
import tracemalloc
from functools import cache

import pytest

from camera_ray_caster.core.annotations.coco import merged_text
from camera_ray_caster.core.sets import SET_FORMATS

from ...scripts.running import ROOT
from . import test_sets

FEW, MANY, MOST = 50, 250, 6400
ALLOWED = 12_000
"""Bytes a further picture, by which the peaks may differ: 0.5 to 2.5 kB were measured, 7.6 where one document has all
frames, and 23 where the arrays of the stubs are held. A real picture has 270.
"""


def stubs(folder, count):
    """A set of pictures that are all the same, but for their frames."""
    folder.mkdir()
    test_sets.view(folder, 1)
    report = json.loads((folder / "PERSP_0001.json").read_text())
    notes = json.loads((folder / "PERSP_0001_coco.json").read_text())
    for frame in range(2, count + 1):
        name = f"PERSP_{frame:04}"
        for ending in ("npz", "png"):
            os.link(folder / f"PERSP_0001.{ending}", folder / f"{name}.{ending}")
        report |= {"frame": frame, "made": {"files": {f"{name}.npz": 1}}}
        (folder / f"{name}.json").write_text(json.dumps(report))
        notes["images"][0]["file_name"] = f"{name}.png"
        (folder / f"{name}_coco.json").write_text(json.dumps(notes))


def test_the_annotations_of_a_run_are_written_picture_by_picture(tmp_path):
    notes = {"info": {}, "images": [{"id": 1, "file_name": "a.png"}], "categories": [{"id": 1, "name": "ball"}],
             "annotations": [{"image_id": 1, "category_id": 1, "id": 1, "segmentation": list(range(100))}],
             "hidden": [], "keypoints": [], "objects": [{"image_id": 1, "matrix": [[0.5] * 4] * 4}] * 4}  # fmt: skip

    class Documents:
        def __init__(self, count):
            self.count = count

        def __iter__(self):
            return (json.loads(json.dumps(notes)) for _ in range(self.count))

    peaks = []
    for count in (100, 1600):
        tracemalloc.start()
        size = sum(map(len, merged_text(Documents(count), tmp_path)))
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert size > 700 * count
    assert peaks[1] - peaks[0] < 3e5  # of 1.3 MB of text, and more as objects


MEASURED = """
import sys
from operator import attrgetter
from pathlib import Path
sys.path[:0] = [{addon!r}, {scripts!r}]
from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Each
from camera_ray_caster.core.exports.file_writer import write
from camera_ray_caster.core.sets import SET_FORMATS, read_set
key, out, *folders = sys.argv[1:]
for folder in map(Path, folders):  # the smaller one first
    if key == "check_set":
        import measure.views
        sys.argv[1:] = [str(folder)]
        assert measure.views.main("") == 0
    elif key in SET_FORMATS:
        points = {{"count": 200}} if key == "colmap-scene" else {{}}  # 10,000 in 6,400 pictures are 2 GB of text
        write(SET_FORMATS[key].files(read_set(folder), **points), Path(out) / folder.name)
    else:
        write(export_files(key, Each(read_set(folder), attrgetter("shot")))[0], Path(out) / folder.name)
    print(*(line for line in open("/proc/self/status") if line.startswith("VmHWM")))
"""


@pytest.fixture(scope="module")
def set_of(tmp_path_factory):
    """A function that returns the folder of a set of so many pictures."""
    folder = tmp_path_factory.mktemp("stubs")

    @cache
    def stub_set(count):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(test_sets, "SIZE", (24, 18))
            stubs(folder / str(count), count)
        return folder / str(count)

    return stub_set


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="Linux tells the peak of a program alone")
@pytest.mark.parametrize(
    "many", [pytest.param(MANY, marks=pytest.mark.full), pytest.param(MOST, marks=pytest.mark.hostile)]
)
@pytest.mark.parametrize("key", [*SET_FORMATS, "colmap", "nerfstudio", "check_set"])
def test_an_export_takes_the_memory_of_a_few_pictures(set_of, tmp_path, key, many):
    code = MEASURED.format(addon=str(ROOT / "addon"), scripts=str(ROOT / "scripts"))
    words = [sys.executable, "-c", code, key, tmp_path, set_of(FEW), set_of(many)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    few, most = (1024 * int(line.split()[1]) for line in done.stdout.splitlines() if line.startswith("VmHWM"))
    assert most - few < ALLOWED * (many - FEW)
