"""The version of the add-on, read from Blender's manifest."""

import tomllib
from pathlib import Path

_MANIFEST = Path(__file__).parents[1] / "blender_manifest.toml"

VERSION: str = tomllib.loads(_MANIFEST.read_text(encoding="utf-8"))["version"]
