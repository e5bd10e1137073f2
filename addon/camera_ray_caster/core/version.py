"""Which version this is: what Blender's manifest says."""

import tomllib
from pathlib import Path

_MANIFEST = Path(__file__).parents[1] / "blender_manifest.toml"

VERSION: str = tomllib.loads(_MANIFEST.read_text(encoding="utf-8"))["version"]
