"""The compositor's File Output nodes. They write to any path in the file, so they run only if the user allows it."""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ..read import changes
from ..read.compositor import compositor_nodes


def writing(scene) -> list:
    """Return the File Output nodes that a render of the scene runs, including nodes in groups."""
    return [node for node in compositor_nodes(scene) if node.type == "OUTPUT_FILE"]


@contextmanager
def muted(nodes: Sequence) -> Iterator[None]:
    """Mute nodes inside the context."""
    with ExitStack() as stack:
        for node in nodes:
            changes.changed(stack, node, mute=True)
        yield


def files(scene, nodes: Sequence) -> dict[Path, tuple]:
    """Return the files in the nodes' output folders, each with its inode, time of change and size."""
    state = {}
    for folder in {folder for node in nodes for folder in _folders(scene, node)}:
        if folder.is_dir():
            with os.scandir(folder) as entries:
                for entry in entries:
                    if entry.is_file():
                        stat = entry.stat()
                        state[folder / entry.name] = stat.st_ino, stat.st_mtime_ns, stat.st_size
    return state


def changed(before: Mapping[Path, tuple], after: Mapping[Path, tuple]) -> tuple[str, ...]:
    """Return the sorted paths of the files that were written between two calls of ``files``."""
    return tuple(sorted(str(path) for path, state in after.items() if before.get(path) != state))


def _folders(scene, node) -> set[Path]:
    """Return the folders of a node's files, with paths expanded by Blender."""
    if hasattr(node, "directory"):  # from 5.0 on
        names = ["", *(item.name for item in node.file_output_items)]
        paths = [os.path.join(node.directory, node.file_name + name) for name in names]
    elif node.format.file_format == "OPEN_EXR_MULTILAYER":
        paths = [node.base_path]
    else:
        paths = [os.path.join(node.base_path, slot.path) for slot in node.file_slots]
    kept, folders = scene.render.filepath, set()
    for path in paths:
        try:
            scene.render.filepath = path.replace("{node_name}", re.sub(r"[/\\]", "_", node.name))
            folders.add(Path(scene.render.frame_path(frame=scene.frame_current)).absolute().parent)
        except RuntimeError:  # unknown template variable in braces: Blender writes nothing
            continue
        finally:
            scene.render.filepath = kept
    return folders
