"""Goes through the scripts' door, in a Blender or with pip's bpy, and prints whether the C library's mallopt was asked
for. Argument: the folder of the scripts.
"""

import sys

names = set()
"""Of all functions that this process has asked ctypes for."""


def hear(event, arguments):
    """Keep the names."""
    if event == "ctypes.dlsym":
        names.add(arguments[1])


if __name__ == "__main__":
    sys.addaudithook(hear)
    sys.path.append(sys.argv[-1])
    import door

    sys.argv[1:] = ["--", "no_such_file.blend"]
    assert door.through("explain") == 2
    print(f"asked for mallopt: {'mallopt' in names}")
