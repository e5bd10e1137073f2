"""Each recipe of CONTRIBUTING.md is followed to its end in a copy; what is left out is named by the test that asks.

All are followed in one copy, and lint, the last command of each, runs once for all.
"""

import re

import pytest

from .following import ROOT, Copy, commands, said_by

PACKAGE = "addon/camera_ray_caster"
CORE = f"{PACKAGE}/core"
DECLARATIONS = "tests/core/cameras/test_declarations.py"
KINDS = "tests/core/shapes/test_kind.py"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the repository."""
    return Copy(tmp_path_factory.mktemp("copy"))


def text_of(path, *changes):
    """The text of a file of the repository with changes."""
    text = (ROOT / path).read_text(encoding="utf-8")
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    return text


def test_a_camera_model(copy):
    model = text_of("tests/blender/add_a_camera/mercator.py", ("1000", "27"))
    copy.write(f"{CORE}/cameras/mercator.py", model)
    copy.change(
        f"{CORE}/cameras/__init__.py",
        ("\nfrom .mirrorball import", "\nfrom .mercator import Mercator\nfrom .mirrorball import"),
        ("\n]  # fmt: skip", " Mercator,\n]  # fmt: skip"),
    )
    said = said_by(copy, DECLARATIONS, "-k", "menu_numbers")
    free = re.search(r"MERCATOR and SCANNER have the number 27: the lowest free one is (\d+)", said)
    assert free, said
    copy.change(f"{CORE}/cameras/mercator.py", ("27", free[1]))
    assert copy.run("scripts/make_docs.py").returncode == 0
    said = said_by(copy, "tests/scenes/test_gallery.py", "-k", "scene_of_its_own")
    assert "MERCATOR: no scene shows it" in said, said
    copy.change(
        "scripts/make/scenes/panoramas.py",
        (
            "def little_planet(scene):",
            '''def mercator(scene):
    """Angles are kept: small shapes have their form wherever they are, and are larger towards the poles."""
    room(scene)
    photograph(scene, MIDDLE, AHEAD, 400, 300, addon={"model": "MERCATOR"})


def little_planet(scene):''',
        ),
    )
    listed = "panoramas.cylindrical,", "panoramas.cylindrical, panoramas.mercator,"
    copy.change("scripts/make/scenes/__init__.py", listed)
    copy.change(
        "tests/scenes/test_stored_settings.py",
        ('    "little_planet": (', '    "mercator": ("MERCATOR", {"mercator_top": 1.4}),\n    "little_planet": ('),
    )
    copy.follow("Add a camera model", NAME="MERCATOR", SCENE="mercator")


def test_a_kind_of_shape(copy):
    disc = text_of(
        "tests/core/shapes/disc.py",
        ('"""A toy kind of shape, in one file: the', '"""The'),
        ("from camera_ray_caster.core.shapes.affine", "from ..records import DISC\nfrom .affine"),
        ("camera_ray_caster.core.", ".."),
        ("number = 7", "number = DISC"),
        ('"disc"', '"round disc"'),
    )
    copy.write(f"{CORE}/shapes/disc.py", disc)
    copy.change(
        f"{CORE}/shapes/kinds.py",
        ("from .kind import Kind", "from .disc import DISCS\nfrom .kind import Kind"),
        ("INFINITE_PLANES, MESHES", "INFINITE_PLANES, MESHES, DISCS"),
    )
    copy.change(f"{CORE}/shape_records.py", ("MESH = 0, 1, 2, 3", "MESH, DISC = 0, 1, 2, 3, 3"))
    copy.change(f"{CORE}/records.py", ("import AREA, ", "import AREA, DISC, "))
    assert "the number 3 of mesh is taken: 4 is free" in said_by(copy, KINDS, "-k", "ships_has")
    copy.change(f"{CORE}/shape_records.py", ("2, 3, 3", "2, 3, 4"))
    assert "KIND_NAMES in core/shape_records.py has no 'round disc' at 4" in said_by(copy, KINDS, "-k", "ships_has")
    copy.change(f"{CORE}/shape_records.py", ('plane", "mesh"', 'plane", "mesh", "round disc"'))
    said = said_by(copy, KINDS, "-k", "ships_has")
    assert "EQUATIONS in core/lesson/meetings.py has no equation of round disc" in said
    copy.change(
        f"{CORE}/lesson/meetings.py",
        ("from ..records import INF", "from ..records import DISC, INF"),
        (
            "def _mesh(",
            '''def _disc(shapes, k, at, along):
    lines, roots = _plane(shapes, k, at, along)
    return lines, [root for root in roots if np.hypot(*(at + root[0] * along)[:2]) <= 1]


def _mesh(''',
        ),
        ("MESH: _mesh}", "MESH: _mesh, DISC: _disc}"),
    )
    imported = "from ..records import INF", "from ..records import DISC, INF"
    copy.change(f"{CORE}/annotations/object_poses.py", imported, ("[row] == PLANE", "[row] in (PLANE, DISC)"))
    copy.change(
        f"{CORE}/motion/landmarks.py", imported, ("(shapes.kind == PLANE) |", "np.isin(shapes.kind, (PLANE, DISC)) |")
    )
    copy.change(
        f"{CORE}/library/shapes.py",
        ("from ..records import INF", "from ..records import DISC, INF"),
        (
            "\ndef mesh(",
            '''
def discs(
    centers, axes=None, *, object_index=0, material_index=0, color=GRAY, name: str | Sequence[str] = "disc"
) -> Shapes:
    """Return discs, or ellipses, one per row of ``centers``; the arguments are those of ``planes``.

    Raises InputError, in one line, for what ``planes`` refuses.
    """
    centers = _rows(centers, "centers")
    return _exact(DISC, centers, _matrices(axes, len(centers), True), object_index, material_index, color, name)


def mesh(''',
        ),
    )
    copy.change(
        f"{PACKAGE}/__init__.py",
        ("shapes import mesh, planes", "shapes import discs, mesh, planes"),
        ('"mesh planes', '"discs mesh planes'),
        ('"explain", ', '"discs", "explain", '),
    )
    joined = "    shapes = crc.join(shapes, "
    copy.change("tests/core/library/every_name.py", (joined, f"{joined}crc.discs((0, 0, -2)), "))
    copy.change(
        f"{PACKAGE}/blender/properties/declared.py",
        ('        Item("MESH",', '        Item("DISC", "Disc", "A disc in local XY", 6),\n        Item("MESH",'),
    )
    copy.change(
        f"{PACKAGE}/blender/read/geometry.py",
        ("import INFINITE_PLANE, PLANE", "import DISC, INFINITE_PLANE, PLANE"),
        ('"INFINITE_PLANE": INFINITE_PLANE}', '"INFINITE_PLANE": INFINITE_PLANE, "DISC": DISC}'),
    )
    copy.follow("Add a kind of shape")


def test_a_pass(copy):
    copy.change(
        f"{CORE}/casting/passes.py",
        (
            "def ray_origin(",
            '''def slope(values: HitValues, out):
    """The cosine of the angle between ray and normal."""
    _store(values, values.cosine, out)


def ray_origin(''',
        ),
        ('    "valid": ', '    "slope": Pass(slope, "Cosine at the normal", shown=AS_IS, missed=0),\n    "valid": '),
    )
    copy.follow("Add a pass", NAME="slope")


def test_a_program(copy):
    copy.write(f"{CORE}/programs/lens_cards.py", text_of("tests/core/programs/lens_cards.py"))
    said = said_by(copy, "tests/core/test_listed.py", "-k", "lens_cards")
    assert "nothing imports core.programs.lens_cards: add it to MODULES in programs/__init__.py" in said
    copy.change(
        f"{CORE}/programs/__init__.py",
        ("    kitti,\n", "    kitti,\n    lens_cards,\n"),
        ("MODULES = (\n", "MODULES = (\n    lens_cards,\n"),
    )
    assert "give a sample" in said_by(copy, "tests/core/programs/test_contract.py", "-k", "lens_cards")
    card = "LENS CARDS\na_0001 64 48 60.5 60.5 32 24 0 -1 0 1 1 0 0 2 0 0 1 3\n"
    copy.write("tests/core/programs/samples/lens_cards.txt", card)
    said = said_by(copy, "tests/core/test_units.py", "-k", "every_reader")
    assert "UNITS of test_units.py has no entry for the lengths of Lens Cards" in said
    copy.change("tests/core/test_units.py", ("UNITS = {\n", 'UNITS = {\n    "Lens Cards": "",\n'))
    copy.follow("Add a program", NAME="lens_cards")


def test_an_export_format(copy):
    copy.write(
        f"{CORE}/exports/eyes.py",
        '''"""Eyes: a line per camera and frame, its name and where it is, in meters."""

from __future__ import annotations

from .format import OWN_TIMES, Format


class Eyes(Format):
    """One file for all cameras."""

    key, label = "eyes", "Eyes"
    description = "The places of the cameras"
    formula = False

    def refusal(self, shot):
        """See Format."""
        return None if shot.camera.pixel_time is None else OWN_TIMES

    def files(self, shots):
        """See Format."""
        rows = [(shot.stem, *(shot.camera.pose.eye * shot.meters).tolist()) for shot in shots]
        yield "eyes.txt", "".join(" ".join(map(str, row)) + "\\n" for row in rows)
''',
    )
    copy.change(
        f"{CORE}/exports/__init__.py",
        ("from .fitted import", "from .eyes import Eyes\nfrom .fitted import"),
        ("Npz(), CameraJson(),\n", "Npz(), CameraJson(), Eyes(),\n"),
    )
    assert "no program of core/programs has the export eyes" in said_by(copy, "tests/core/cameras/test_readme.py")
    program = 'PROGRAM = ProgramFiles("Eyes", "eyes.txt", lost="lenses", export=FileWriter("eyes", "Eyes", ""))'
    imports = "from __future__ import annotations\n\nfrom .parts.program import FileWriter, ProgramFiles"
    docs = '"""Places of cameras; ``core.exports`` writes them, of whole cameras."""'
    copy.write(f"{CORE}/programs/eyes.py", f"{docs}\n\n{imports}\n\n{program}\n")
    copy.change(
        f"{CORE}/programs/__init__.py",
        ("    euroc_trajectory,\n", "    euroc_trajectory,\n    eyes,\n"),
        ("MODULES = (\n", "MODULES = (\n    eyes,\n"),
    )
    copy.follow("Add an export format")


def test_each_recipe_ends_with_lint(copy):
    for heading in ("Add a camera model", "Add a kind of shape", "Add a pass", "Add a program", "Add an export format"):
        assert commands(heading)[-1] == "make lint"
    copy.lint()
