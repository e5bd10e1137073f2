"""Whether a signal has asked this process to stop.

A signal's handler raises nothing at first: Python may run it in a callback of Blender's, which prints an exception and
drops it. It remembers that it was called, and work that takes long asks. A second signal ends the process at once.
"""

from ...core.records import Cancelled

_stopping = False


def stop(*_) -> None:
    """Ask what is running to end; the second time, raise KeyboardInterrupt. For ``signal.signal``."""
    global _stopping
    if _stopping:
        raise KeyboardInterrupt
    _stopping = True


def is_stopping() -> bool:
    """Return whether what is running has been asked to end."""
    return _stopping


def raise_if_stopping() -> None:
    """Raise Cancelled where what is running has been asked to end."""
    if _stopping:
        raise Cancelled


def reset() -> None:
    """Forget what was asked: what runs next is not concerned."""
    global _stopping
    _stopping = False
