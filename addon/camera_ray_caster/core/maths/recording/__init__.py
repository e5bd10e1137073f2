"""Numbers that record what is done to them: a formula in numpy becomes a list of operations.

The formula is called once with such numbers, and what it did to them is its ``Record``, which can be evaluated with any
number of digits, written in another language, or differentiated. ``record`` makes one. ``loop`` and ``look_up`` are how
a formula iterates and reads tables, with arrays as with recorded numbers.
"""

from .derivatives import Dual, differentiate
from .number import NotRecordable, Parameter, Recorded, is_recorded, look_up, loop, record, roundoff, stop_gradient
from .record import DOMAIN, NUMPY, Record, Step

__all__ = [
    "DOMAIN", "NUMPY", "Dual", "NotRecordable", "Parameter", "Record", "Recorded", "Step", "differentiate",
    "is_recorded", "look_up", "loop", "record", "roundoff", "stop_gradient",
]  # fmt: skip
