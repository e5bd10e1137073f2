"""STMaps: pairs of EXR images between two lenses; ``core.exports`` writes them, of whole cameras."""

from .parts.program import FileWriter, ProgramFiles

PROGRAM = ProgramFiles(
    "STMaps", "pairs of .exr", lost="what is seen from two places; poses",
    export=FileWriter("stmap", "STMaps", "", ending=".exr"),
)
