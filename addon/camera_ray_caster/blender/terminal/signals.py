"""Whether the command under way is to end: a signal came for this process.

A signal's handler raises nothing at first: Python may run it in a callback of Blender's, which prints an exception and
drops it. It notes that it was called, and what takes long asks. A second signal is not waited for.
"""

from ...core.records import Cancelled

_noted = False


def note(*_) -> None:
    """Let what is under way end soon, at once the second time: to be called where a signal ends the process."""
    global _noted
    if _noted:
        raise KeyboardInterrupt
    _noted = True


def noted() -> bool:
    """Return whether what is under way is to end."""
    return _noted


def heed() -> None:
    """Raise Cancelled where what is under way is to end."""
    if _noted:
        raise Cancelled


def forget() -> None:
    """Let what comes next go its whole way."""
    global _noted
    _noted = False
