"""What dataset.json has once comes back in each report and in the annotations; sets without it stay as they are."""

import json

from camera_ray_caster.core.sets import read_set
from camera_ray_caster.core.sets.shared_facts import with_objects, without_objects

from .test_sets import view, written_set  # noqa: F401

OBJECTS = [{"shape_index": row, "matrix": [row]} for row in range(4)]


def test_objects_that_stand_still_are_not_repeated():
    moved = [*OBJECTS[:2], {"shape_index": 2, "matrix": [0.5]}, OBJECTS[3]]
    stored = without_objects({"images": [], "objects": moved}, OBJECTS)
    assert stored == {"images": [], "moved": [moved[2]]}
    assert with_objects(stored, OBJECTS) == {"images": [], "objects": moved}


def test_other_objects_are_stored_whole():
    document = {"objects": OBJECTS[1:]}
    assert without_objects(document, OBJECTS) is document
    assert with_objects(document, OBJECTS) is document


def test_entries_of_a_report_come_from_the_set_unless_it_has_its_own(written_set):  # noqa: F811
    folder = written_set[0]
    before = [(picture.meters, picture.annotations["objects"]) for picture in read_set(folder)]
    (folder / "dataset.json").write_text(json.dumps({"common": {"host": {"meters": 0.25}}, "objects": before[0][1]}))
    first, second = sorted(folder.glob("*_000?.json"))
    report = json.loads(first.read_text())
    del report["host"]
    first.write_text(json.dumps(report))
    notes = json.loads(second.with_name(f"{second.stem}_coco.json").read_text())
    second.with_name(f"{second.stem}_coco.json").write_text(json.dumps(without_objects(notes, before[0][1])))
    views = read_set(folder)
    assert [picture.meters for picture in views] == [0.25, before[1][0]]
    assert [entry.annotations["objects"] for entry in views] == [entry for _, entry in before]
