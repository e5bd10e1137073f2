"""What a recipe of CONTRIBUTING.md adds as a file is in the list that it joins, and what the tiers name is a file."""

import pytest

from .. import tiers
from .test_architecture import MODULES, ROOT, all_imports, name_of

LISTS = {
    "core.cameras": "MODELS in cameras/__init__.py",
    "core.exports": "EXPORT_FORMATS in exports/__init__.py",
    "core.programs": "MODULES in programs/__init__.py",
    "core.shapes": "SHAPE_KINDS in shapes/kinds.py",
}


FILES = [name_of(path) for path in MODULES if path.name != "__init__.py"]


@pytest.mark.parametrize("module", sorted(name for name in FILES if name.rpartition(".")[0] in LISTS))
def test_a_file_is_listed(module):
    imported = set().union(*(inside for inside, _ in all_imports().values()))
    assert module in imported, f"nothing imports {module}: add it to {LISTS[module.rpartition('.')[0]]}"


def test_files_that_the_tiers_name_are_there():
    """Renamed, they would silently leave the tier, or lose their turn."""
    assert [path for path in (*tiers.FULL, *tiers.LONGEST) if not (ROOT / path).exists()] == []
