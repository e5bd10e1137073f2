"""The tuned constants of a cast, each with the measurement that gave it. They change its speed, never its picture.

Times are of whole casts at 1920 x 1080 with two threads, in pairs of runs with and without, medians of 15; passes are
four (depth, normal, position, object_index) or two (depth, shape_index). N spheres stand before a wall.
"""

SMALL_PIXELS = 1 << 13
"""A shape with fewer pixels in its bounds is tested in a batch with others, since a call of numpy costs more than its
pixels. No batches at all: 1.4 to 1.5 times the time for 1,000 spheres, 4.4 to 5.6 for 10,000. 2**15: 1.3 to 1.5 times
for 100 spheres; 2**11: within 6 %.
"""

BATCH_PIXELS = 1 << 18
"""Pixels of the bounds of the small shapes that are tested at once. 2**15: 1.2 to 1.5 times the time for 1,000 and
10,000 spheres, since threads wait for each other; no limit: within 5 %, but memory without limit.
"""

PREPARED_PIXELS = 1 << 16
"""Rows and columns of large shapes whose terms are made at once. One shape at a time: 1.2 times the time for 100
spheres and two passes, 1.03 to 1.06 otherwise.
"""

FAR = 1e4
"""Radii. The normal of a sphere nearer than that has unit length to 1e-11 as it comes, and is not divided by its
length. Always divided: 1.2 to 1.4 times the time where normals are asked for.
"""

BLOCK_PIXELS = 1 << 17
"""Pixels whose passes are made at once: fewer calls of numpy, between which threads wait for each other, gain more than
arrays that stay in a core's cache. 2**15: 1.2 to 1.3 times the time of meshes and of 10 spheres, 1.4 to 1.6 times that
of error bounds; 2**16: 1.0 to 1.1 and 1.2 times; of 1,000 and 10,000 spheres both within 7 %.
"""

TILE_PIXELS = 1 << 18, 1 << 20
"""The fewest and the most pixels of a tile, the unit of threads, progress and canceling."""

TILE_WORK = 1 << 23
"""The most work of a tile, all its samples counted: a tenth of a second. Below that a thread has one tile."""

SERIAL_WORK = 1 << 18
"""Work that takes as long as what threads do one at a time for a tile, holding the interpreter: 0.4 to 3 ms, measured
with 1 to 15 tiles. Without heed to it 16 threads took two to four times as long as two.
"""

CHUNK = 1 << 16
"""Vertices or triangles of meshes that are placed at once. Times as below: 2**14 within 6 %, 2**20 up to 1.1 times."""

BOUNDED = 1 << 12
"""Triangles whose balls are bounded at once: a strip's takes some microseconds, and a stop is heard between them."""

SURFACES = 1 << 12
"""Triangles whose normals are made constants at once. 2**10 to 2**18: within the noise, but memory without limit."""

SLABS, SLAB_PIXELS = 2, 1 << 17
"""Parts in which triangles are tested, the nearest first: what they hide is not tested. They are SLABS times the root
of the triangles' work over the tile's pixels, since before each the whole tile is asked what is hidden, and SLAB_PIXELS
more for numpy's calls. Processor time of depth and shape index of a monkey of 1,000, 63,000 and a million triangles
before a wall, and of a thousand monkeys: SLABS 1: 0.95, 1.04, 1.24 and 1.19 times; 3: 1.04, 1.05, 1.01 and 1.09. Always
four parts, and what is larger than a cell never hidden: 1.1 to 1.4 times, of the thousand 3 times. SLAB_PIXELS 0: 1.5
times the time of 60 monkeys of 3,936 in 200 x 119 pixels; up to 2**18: within the noise of those casts.
"""

TRIANGLE_PIXELS = 16
"""Pixels whose test takes about as long as what a triangle takes beside them; profiles of these casts say 8 to 20."""

CELL = 8
"""Pixels of the sides of the smallest cells whose farthest t is asked for. 4: 1.2 to 1.3 times the time of one monkey,
0.9 of a thousand; 16: 0.95 of these.
"""

SPANNED, SPANNED_PIXELS = 1 << 15, 1 << 19
"""Triangles whose spans are found at once, and pixels of their bounds. An eighth and a quarter: 1.1 to 1.25 times the
time of those casts and of a thousand monkeys; twice: within 4 %, but more memory.
"""

TRACED_PIXELS = 1 << 17
"""The same of triangles that are tested ray by ray. 2**15: 1.1 times the time of a fisheye; 2**18: within 3 %."""
