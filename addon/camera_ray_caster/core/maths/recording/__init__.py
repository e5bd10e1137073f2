"""Numbers that record the operations on them: a formula in numpy becomes a list of operations.

``record`` calls the formula once with such numbers and returns its operations as a ``Record``, which can be evaluated
with any number of digits, written in another language, or differentiated. With ``loop`` and ``look_up`` a formula
iterates and reads tables, for arrays as well as for recorded numbers.
"""

from .derivatives import Dual, differentiate
from .entries import Entries
from .known import record_known
from .number import (
    NotRecordable,
    Parameter,
    Recorded,
    is_recorded,
    least_root,
    look_up,
    loop,
    may_hold,
    record,
    roundoff,
    stop_gradient,
)
from .record import DOMAIN, NUMPY, Operation, Record, needed
from .varied import Varied, array, cos, sin, tan, vector

__all__ = [
    "DOMAIN",
    "NUMPY",
    "Dual",
    "Entries",
    "NotRecordable",
    "Operation",
    "Parameter",
    "Record",
    "Recorded",
    "Varied",
    "array",
    "cos",
    "differentiate",
    "is_recorded",
    "least_root",
    "look_up",
    "loop",
    "may_hold",
    "needed",
    "record",
    "record_known",
    "roundoff",
    "sin",
    "stop_gradient",
    "tan",
    "vector",
]  # fmt: skip
