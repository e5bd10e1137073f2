"""The properties that are made from declarations: those of version 0.1 are what they were, down to the tooltips (but
where what an item, a coefficient or a file does has become more).
"""

import json
from pathlib import Path

import pytest

from camera_ray_caster.blender.properties.groups import CameraProperties, ObjectProperties, SceneProperties

BEFORE = json.loads(Path(__file__).with_name("properties_of_0_1.json").read_text(encoding="utf-8"))
"""What Blender said of each property of 0.1, by group and name."""
GROUPS = {group.__name__: group for group in (CameraProperties, ObjectProperties, SceneProperties)}


def facts_of(prop):
    """What Blender says of a property, as lists, words and numbers, but for its description, which no file needs."""
    facts = {"type": prop.type, "name": prop.name}
    if prop.type in ("FLOAT", "INT"):
        facts["default"] = list(prop.default_array) if prop.is_array else prop.default
        facts["hard"], facts["soft"] = [prop.hard_min, prop.hard_max], [prop.soft_min, prop.soft_max]
        facts["step"] = prop.step
    if prop.type == "FLOAT":
        facts["precision"] = prop.precision
        facts |= {"unit": "LENGTH"} if prop.unit == "LENGTH" else {}
        facts |= {"subtype": "ANGLE"} if prop.unit == "ROTATION" else {}
    if prop.type == "ENUM":
        facts["items"] = [[item.identifier, item.name, item.description, item.value] for item in prop.enum_items]
    if prop.type in ("ENUM", "STRING", "BOOLEAN"):
        facts["default"] = prop.default
    if prop.type == "STRING":
        facts["subtype"] = prop.subtype
    if prop.type == "POINTER":
        facts["fixed"] = prop.fixed_type.identifier
    return facts


@pytest.mark.parametrize("name", BEFORE)
def test_a_property_of_0_1_is_what_it_was(name):
    """A choice may have more items, in another order: a .blend stores their numbers."""
    group, _, name = name.partition(".")
    before, facts = BEFORE[f"{group}.{name}"], facts_of(GROUPS[group].bl_rna.properties[name])
    if "items" in before:
        items = [item for item in facts["items"] if item[0] in {key for key, *_ in before["items"]}]
        facts["items"] = sorted(items, key=lambda item: item[3])
        before["items"].sort(key=lambda item: item[3])
    assert facts == before


def test_every_item_of_a_choice_has_a_number_of_its_own():
    for group in GROUPS.values():
        for setting in group.bl_rna.properties:
            if setting.type == "ENUM" and setting.is_runtime:
                numbers = [item.value for item in setting.enum_items]
                free = min(set(range(len(numbers) + 1)) - set(numbers))
                assert len(set(numbers)) == len(numbers), f"two items of {setting.identifier} share one: {free} is free"


def test_only_objects_of_the_declared_types_can_be_a_slit_or_a_path(blender):
    curve, mesh = blender.data.curves.new("Curve", "CURVE"), blender.data.meshes.new("Mesh")
    items = [blender.data.objects.new("Item", data) for data in (None, curve, mesh)]
    settings = blender.data.cameras.new("Camera").camera_ray_caster
    for name, types in (("slit_1", {"EMPTY", "CURVE"}), ("slit_2", {"EMPTY", "CURVE"}), ("path", {"CURVE"})):
        poll = CameraProperties.__annotations__[name].keywords["poll"]
        assert {item.type for item in items if poll(settings, item)} == types


def test_what_a_script_changes_is_evaluated(blender):
    """Blender evaluates anew what its windows change; a script's change has to be told."""
    scene, camera = blender.context.scene, blender.data.objects.new("Camera", blender.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    depsgraph = blender.context.evaluated_depsgraph_get()
    for tilt in (0.25, 0.5):
        camera.data.camera_ray_caster.tilt = tilt
        depsgraph.update()
        assert camera.evaluated_get(depsgraph).data.camera_ray_caster.tilt == tilt
