"""The picture of the house shows the rooms that there are, and every import follows its arrows."""

import importlib.util
import re

from .test_architecture import MAY_IMPORT, PACKAGE, ROOT, all_imports

SPEC = importlib.util.spec_from_file_location("architecture", ROOT / "scripts" / "make" / "architecture.py")
architecture = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(architecture)


def reach(arrows, room):
    """The rooms to which arrows lead."""
    return set().union(*({other} | reach(arrows, other) for other in arrows.get(room, ())))


def test_every_room_is_shown_and_every_import_follows_arrows():
    table = architecture.table_of(ROOT / "tests" / "core" / "test_architecture.py")
    assert table == MAY_IMPORT
    for band in ("core", "blender"):
        arrows = architecture.rooms_of(table, band)
        folders = {path.name for path in (PACKAGE / band).iterdir() if (path / "__init__.py").is_file()}
        assert folders <= set(arrows)
        for name, (inside, _) in all_imports().items():
            rooms = {other.split(".")[1] for other in inside if other.startswith(f"{band}.")}
            room = name.split(".")[1] if name.startswith(f"{band}.") else None
            if room is not None:
                assert rooms - {room} <= reach(arrows, room), name


def test_the_picture_has_each_room_once():
    picture = (ROOT / "docs" / "pictures" / "architecture.svg").read_text(encoding="utf-8")
    shown = re.findall(r"<text[^>]*>(\w+)</text>", picture)
    arrows = [architecture.rooms_of(MAY_IMPORT, band) for band in ("blender", "core")]
    assert sorted(shown) == sorted(["camera_ray_caster", "blender", "core", *arrows[0], *arrows[1]])
    assert picture.count("<path") == 2 + sum(len(others) for targets in arrows for others in targets.values())
