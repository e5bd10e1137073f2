"""The tuned constants of a cast, each with the measurement that gave it. They change its speed, never its picture.

Unless said otherwise, times are those of whole casts at 1920 x 1080 with two threads, medians of 15 pairs of runs, one
with the constant as it is and one with it changed. The passes are four (depth, normal, position, object_index) or two
(depth, shape_index). "N spheres" are spheres in front of a wall.
"""

SMALL_PIXELS = 1 << 13
"""Number of pixels in a shape's bounds below which it is tested in a batch with others, since a numpy call costs more
than its pixels. Without batches: 1.4 to 1.5 times the time for 1,000 spheres, 4.4 to 5.6 for 10,000. 2**15: 1.3 to 1.5
times for 100 spheres; 2**11: within 6 %.
"""

BATCH_PIXELS = 1 << 18
"""Number of pixels, over the bounds of small shapes, in one batch. 2**15: 1.2 to 1.5 times the time for 1,000 and
10,000 spheres, since threads wait for each other; no limit: within 5 %, but the memory is unlimited, too.
"""

SEARCHED_PIXELS = 1 << 18
"""Number of pixels in the bounds of a large shape that are tested at once: a plane covers or misses many bands of rows
as a whole. No limit: 1.5 times the processor time of three planes and 92 spheres and ellipsoids with two passes, 1.13
with these and combined, position and normal; 2**17: 0.95 and 1.0 times, and more calls for 10 spheres.
"""

PREPARED_PIXELS = 1 << 16
"""Number of rows plus columns, over all shapes of a group, whose terms are computed at once for large shapes. One shape
at a time: 1.2 times the time for 100 spheres and two passes, 1.03 to 1.06 otherwise.
"""

FAR_SPHERE = 1e4
"""Distance of a sphere in radii. The computed normal of a nearer sphere has unit length to 1e-11, and is not divided by
its length. Always divided: 1.2 to 1.4 times the time of casts with normals.
"""

BLOCK_PIXELS = 1 << 16
"""Number of pixels whose passes are written at once. Processor time with 2**17: 1.0 to 1.1 times that of four passes;
of error bounds 1.35 times for 10 spheres, 1.05 for 1,000 and 0.92 for a mesh of 63,000 triangles. With 2**15 1.0 to
1.05 times that of four passes; by the clock 1.2 to 1.3 times, since threads wait for each other between numpy's calls.
"""

LAYER_PIXELS, LAYERED = 1 << 12, 1.5
"""Passes are written shape by shape if the pixels in the bounds of the shapes that may be seen, plus LAYER_PIXELS for
each shape, are at most LAYERED times those of the picture. Never: 1.35 times the processor time for 10 spheres without
a wall and four passes.
"""

TILE_PIXELS = 1 << 18, 1 << 20
"""Minimum and maximum number of pixels in a tile, the unit of threads, progress and canceling. Each thread has a tile
with fewer pixels if it has that many rays: with 16 samples, two tiles of 640 x 400 pixels take 1.0 to 1.09 times the
processor time of one, which a single thread casts.
"""

TILE_WORK = 1 << 23
"""Maximum work of a tile, counting all its samples: a tenth of a second. With less work each thread has one tile."""

SERIAL_WORK = 1 << 18
"""Work that takes as long as the part of a tile that threads do one at a time, holding the interpreter: 0.4 to 3 ms,
measured with 1 to 15 tiles. If this part is ignored, 16 threads take two to four times as long as two.
"""

MESH_BLOCK = 64
"""Number of consecutive triangles of a mesh that are found visible or hidden together. 16, 32 and 128: within 5 % of
the time of the casts of SLAB_PIXELS.
"""

CHUNK = 1 << 16
"""Number of mesh vertices placed, or triangles bounded, at once; before that, blocks behind the hits so far are left
out. In the casts of SLAB_PIXELS: 2**14 1.0, 1.0, 1.45, 1.2 times, 2**18 1.0, 1.0, 1.0, 1.3.
"""

BALLS = 1 << 15
"""The same for triangles that are bounded as balls, since lines may look curved. A cast can be stopped only between two
chunks, and a strip camera takes 2 to 4 microseconds for a ball.
"""

SURFACES = 1 << 14
"""Number of triangles whose normals are computed at once. For 250,000 and a million triangles 2**12: 1.03 times, 2**16:
1.0 and 1.08.
"""

SLAB_PIXELS = 1 << 17
"""Number of pixels that take as long to check as the numpy calls for a slab. Triangles are tested in slabs, the nearest
first, and those behind a tested slab are skipped; the number of slabs is the square root of the triangles' work over
(the tile's pixels plus SLAB_PIXELS). Time of four passes for a monkey head of 1,000, 252,000 and a million triangles
before a wall, and for a thousand heads: 1.4 times as many slabs 0.98, 1.01, 1.08 and 0.99 times; equal numbers of
triangles in place of equal work 1.08, 1.07, 0.98 and 1.06; 0.7 of these slabs 1.1, 1.09, 1.01 and 1.05. Always four,
without skipping triangles larger than a cell: 1.1 to 1.4 times, for the thousand 3 times. 0: 1.5 times the time for 60
heads of 3,936 triangles in 200 x 119 pixels; up to 2**18: within the noise.
"""

TRIANGLE_PIXELS = 16
"""Number of pixel tests that take as long as the other work for a triangle: 8 to 20 in profiles of these casts."""

CELL = 8
"""Side, in pixels, of the smallest cells whose farthest t is computed. 4: 1.03 to 1.09 times the time of the casts of
SLAB_PIXELS; 16: 1.0 to 1.04 times.
"""

SPANNED, SPANNED_PIXELS = 1 << 15, 1 << 19
"""Number of triangles whose spans are computed at once, and number of pixels in their bounds. An eighth of the
triangles: 1.1 times the time for a million; a quarter of the pixels: 1.1 to 1.25 times that of casts of SLAB_PIXELS;
twice as many: within 4 %, but more memory.
"""

RAY_CELL = 24
"""Side, in pixels, of the cells of a tile in which rays are taken as linear functions of the pixel. Processor time
of two passes of 88,000 triangles by a distorted pinhole, OpenCV's fisheye, a pushbroom and a cross-slit camera: 8: 2.5,
1.3, 1.35 and 2.5 times; 16: 1.2, 1.05, 0.95 and 1.3; 32: 0.95, 1.0, 1.0 and 0.95; at 574 x 323 pixels all but 8 within
a tenth.
"""

WIDE_CELL, WIDE_TILES, WIDE_PIXELS = 96, 64, 1 << 25
"""If the bounds of triangles with more pixels than four squares of WIDE_CELL have more than WIDE_TILES times the pixels
of their tile, these triangles are looked for in such squares first, as many at once as have WIDE_PIXELS in their
bounds. Processor time of a street of 325 meshes with 16 samples at 640 x 400, by cross-slit cameras with slits in the
scene and at the camera: never: 3.3 and 0.9 to 1.1 times; of a room by the latter 1.1 to 1.4. Not tuned beyond that.
"""

NARROWED_TILES = 4
"""If the bounds of planes have more than this many times the pixels of their tile, the cells narrow them first. Never:
1.1 times the processor time of two passes of a room with 40 planes by a distorted pinhole, of which 12 million pixels
are tested for 2.2 million hits, with them 3 to 4 million. Not tuned: it keeps pictures of few planes from paying.
"""

TRACED_PIXELS = 1 << 17
"""Number of pixels of triangles whose t is computed at once, and of those that cells leave open and that are tested ray
by ray. Not tuned: 2**14 to 2**22 take 0.94 to 1.25 times the time for 36 balls by a distorted pinhole, in two runs of
two casts each on a busy machine, without an order.
"""

BOXED_PIXELS = 1 << 22
"""Number of pixels in the bounds of triangles whose cells are tested at once. Processor time of two passes of a street
and a room by a distorted pinhole: 2**21: 1.05 and 1.15 times, 2**23: 0.95; of a street by a pushbroom 2**23: 1.3.
"""

HALVED_PIXELS, HALVINGS = 1 << 15, 2
"""Triangles bounded by balls are bounded by those of their quarters if the bounds have more pixels, so many times.
Processor time of two passes of a street and a room by a distorted pinhole: never: 1.1 and 1.15 to 1.3 times; once: 1.0,
three times: 1.0; 2**13: 1.0 and 1.05. By OpenCV's fisheye all are within 5 %.
"""
