"""Any camera model as a custom camera of Cycles: its rays as a shader in the file."""

from .convert import from_cycles, to_cycles
from .projector_lamp import add_projector

__all__ = ["add_projector", "from_cycles", "to_cycles"]
