"""The names of models before version 1.0, which still work with a warning."""

from inspect import signature
from typing import Any

from ...arguments import deprecated


class OldNames:
    """``frame`` was the size of the picture, and ``size`` that of a device."""

    size: Any

    def __new__(cls, *values: Any, **fields: Any):
        """Refuse ``frame=`` of a model that has no such field of its own."""
        if "frame" in fields and "frame" not in signature(cls.__init__).parameters:
            raise TypeError(f"{cls.__name__} has no frame: give size=, (width, height) in pixels")
        return super().__new__(cls)

    def __init_subclass__(cls, **arguments: Any):
        super().__init_subclass__(**arguments)
        if isinstance(vars(cls).get("size"), property):
            deprecated("Model.size of a device is Model.device_size")
            setattr(cls, "device_size", vars(cls)["size"])  # noqa: B010 (mypy knows it as a property)
            del cls.size

    @property
    def frame(self) -> tuple[int, int]:
        """Width and height of the full picture in pixels."""
        deprecated("Model.frame is Model.size")
        return self.size
