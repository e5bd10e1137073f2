"""Notes on passes that show something else than their readers may expect."""

from collections.abc import Sequence

from ..camera.camera import Camera

APART = 1e-3
"""Distance of an exact shape from its mesh, over its radius or longer half side, beyond which it is noted."""

NAMED = 3
"""Maximum number of objects that a sentence names."""


def camera_notes(camera: Camera) -> tuple[tuple[str, str], ...]:
    """Return the remark of a camera's model with the camera's name."""
    remark = camera.model.remark(camera.record)
    return ((camera.record.name, remark),) if remark else ()


def sentences(notes: Sequence[tuple[str, str]], exact: Sequence[tuple[str, float]]) -> list[str]:
    """Return the notes of ``Shapes``, those that are the same in one sentence, and the deviation of exact shapes."""
    names: dict[str, list[str]] = {}
    for name, note in notes:
        names.setdefault(note, []).append(name)
    return [f"{_named(noted)}: {note}" for note, noted in names.items()] + _deviation(exact)


def _deviation(exact: Sequence[tuple[str, float]]) -> list[str]:
    away = sorted(((apart, name) for name, apart in exact if apart > APART), reverse=True)
    if not away:
        return []
    names = list(dict.fromkeys(name for _, name in away))
    return [
        f"{_named(names)}: the exact shape is up to {away[0][0]:.2%} of its radius away from the mesh: Cast As Mesh "
        "casts the mesh, and disabling Exact Shapes casts all meshes"
    ]


def _named(names: Sequence[str]) -> str:
    unnamed = len(names) - NAMED
    return ", ".join(map(repr, names[:NAMED])) + (f" and {unnamed} more" if unnamed > 0 else "")
