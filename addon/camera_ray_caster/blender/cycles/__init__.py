"""Any camera model as a custom camera of Cycles: its rays as a shader in the file."""

from .convert import from_cycles, to_cycles

__all__ = ["from_cycles", "to_cycles"]
