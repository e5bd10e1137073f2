"""The bytes of a .blend, changed: what Blender itself still opens is to be cast, or refused."""

from .parts import Hostile

COUNT = 150


def make(chance, number, folder):
    """Save the scene and change its bytes."""
    import bpy

    path = folder / "bytes.blend"
    bpy.context.preferences.filepaths.use_file_compression = False
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, compress=number % 10 == 9)
    data = bytearray(path.read_bytes())
    ways = (_flipped, _flipped, _flipped, _numbers, _numbers, _numbers, _numbers, _cut, _header)
    way = ways[number % len(ways)]
    change = way(chance, data)
    path.write_bytes(data)
    return Hostile(f"{way.__name__[1:]} {change}", file=path)


def _flipped(chance, data):
    places = [chance.randrange(len(data)) for _ in range(chance.choice((1, 3, 10)))]
    for offset in places:
        data[offset] ^= 1 << chance.randrange(8)
    return f"bits at {places}"


def _numbers(chance, data):
    """Blender's data are mostly float32 and int32 at places that 4 divides."""
    hostile = (b"\0\0\xc0\x7f", b"\0\0\x80\x7f", b"\xff\xff\xff\x7f", b"\xff\xff\xff\xff", b"\0\0\0\x80", b"\0\0\0\0")
    known = [offset for offset in range(0, len(data) - 4, 4) if data[offset : offset + 4] == b"\0\0\x80\x3f"]  # 1.0
    places = [chance.choice(known) for _ in range(chance.choice((1, 5, 20)))] if known else []
    for offset in places:
        data[offset : offset + 4] = chance.choice(hostile)
    return f"at {places}"


def _cut(chance, data):
    del data[chance.randrange(len(data)) :]
    return f"at {len(data)}"


def _header(chance, data):
    offset, value = chance.randrange(min(64, len(data))), chance.randrange(256)
    data[offset] = value
    return f"{value} at {offset}"
