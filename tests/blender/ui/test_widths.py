"""Labels and sentences fit the sidebar at its default width, by Blender's own font."""

import numpy as np
import pytest

from camera_ray_caster.blender.properties import groups
from camera_ray_caster.blender.ui import drawing, gallery_panels
from camera_ray_caster.core.camera import pixel_time
from camera_ray_caster.core.cameras import MODELS

REGION = 292
"""Width of the default sidebar in pixels at interface scale 1."""
CONTENT = 236
"""Width of its rows: without tabs and margins."""
ICON, VALUE = 24, 64
"""What an icon or a tick box takes of a row, and what the value of a number field takes with its arrows."""
PICTURE = 80
"""Width of a name below a picture of the gallery."""


width = drawing.text_width


def test_labels_fit_beside_their_values():
    settings = [setting for model in MODELS for setting in model.SETTINGS]
    settings += [setting for some in pixel_time.SETTINGS.values() for setting in some]
    labels = {setting.label for setting in settings}
    labels |= {entry.name for group in groups.CLASSES for entry in group.bl_rna.properties}
    assert len(labels) > 100
    assert {label: width(label) for label in labels if width(label) > CONTENT - VALUE} == {}
    room = drawing.label_room(REGION)
    assert 90 < room < CONTENT / 2
    wide = {label for label in labels if width(label) > room}
    assert "Interocular Distance" in wide, "it has no label beside its field: see draw_field"
    assert len(wide) < 10
    assert width("Natural Falloff") < drawing.label_room(REGION, is_tick=True) < width("Chromatic Aberration"), "cut"
    ticks = [entry.name for entry in groups.SceneProperties.bl_rna.properties if entry.type == "BOOLEAN"]
    assert {name: width(name) for name in ticks if width(name) > CONTENT / 2 - ICON} == {}, "two stand in a row"


def test_names_in_the_gallery_fit_below_their_pictures():
    items = gallery_panels._pictures(None, None)
    assert {name: width(name) for _, name, *_ in items if width(name) > PICTURE} == {}
    names = [name for _, name, *_ in items]
    assert len(set(names)) == len(names)
    assert set(gallery_panels.SHORT) <= {key for key, *_ in items}


@pytest.fixture
def context(blender, monkeypatch):
    monkeypatch.setattr(drawing, "width_of", lambda context: REGION)
    return blender.context


def test_wrapped_sentences_fit(context):
    texts = [setting.text for model in MODELS for setting in model.SETTINGS] + [model.description for model in MODELS]
    room = drawing.width_of(context) - drawing.BESIDE - drawing.ICON
    lines = [line for text in texts for line in drawing.lines_of(text, room)]
    assert len(lines) > 500
    assert {line: width(line) for line in lines if width(line) > CONTENT - ICON} == {}
    assert np.median([width(line) for line in lines]) > 0.85 * room, "no room is left unused"
