"""Lens files: each format, what its files get wrong, and refusals that name the file and the surface."""

import json
from contextlib import suppress

import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.lenses.optics import Optics
from camera_ray_caster.core.lenses.read import read_lens

# radius, distance behind, index, diameter of a doublet with its stop behind it
ROWS = [(60.0, 6.0, 1.52, 24.0), (-40.0, 2.0, 1.62, 24.0), (-150.0, 5.0, 1.0, 22.0), (0.0, 3.0, 1.0, 12.0)]


def optical_bench(rows=ROWS, extra=""):
    lines = ["[lens data]"]
    for number, (radius, gap, index, diameter) in enumerate(rows):
        name = "AS" if radius == 0 else str(number + 1)
        lines.append(f"{name}\t{radius or 'Infinity'}\t{gap}\t{index if index > 1 else ''}\t{diameter}\t")
    return "\n".join(lines) + "\n" + extra


def isetcam(rows=ROWS):
    keys = "radius", "thickness", "ior", "semi_aperture"
    surfaces = [dict(zip(keys, (*row[:3], row[3] / 2), strict=True)) for row in rows]
    return json.dumps({"name": "doublet", "surfaces": surfaces})


def zemax(rows=ROWS, unit="MM", size=1.0):
    lines = ["VERS 1", f"UNIT {unit} X W X CM MR CPMM", "SURF 0", "  TYPE STANDARD", "  DISZ INFINITY"]
    for number, (radius, gap, index, diameter) in enumerate(rows, 1):
        lines += [f"SURF {number}", "  TYPE STANDARD", f"  CURV {size / radius if radius else 0.0!r} 0 0"]
        lines += ["  STOP"] if radius == 0 else []
        lines += [f"  DISZ {gap / size!r}", f"  DIAM {diameter / 2 / size!r} 1 0 0"]
        lines += [f"  GLAS ___BLANK 1 0 {index} 60.0"] if index > 1 else []
    return "\n".join([*lines, f"SURF {len(rows) + 1}", "  DISZ 0"])


def rayoptics(rows=ROWS, profile="Spherical", **more):
    """As RayOptics saves it, but for what is of no use here."""

    def instance(kind, **attributes):
        return {"__instance_type__": ["rayoptics", kind], "attributes": attributes}

    surfaces = [(0.0, 1e10, 1.0, 0.0), *rows, (0.0, 0.0, 1.0, 40.0)]
    ifcs, gaps, profiles = [], [], {}
    for number, (radius, gap, index, diameter) in enumerate(surfaces):
        asphere = more if number == 1 else {"coefs": []}
        profiles[str(number)] = instance(profile, cv=1 / radius if radius else 0.0, **asphere)
        ifcs.append(instance("Surface", profile_id=number, max_aperture=diameter / 2, clear_apertures=[], decenter=None,
                         interact_mode="transmit"))  # fmt: skip
        medium = instance("ModelGlass", n=index, v=60.0) if index > 1 else instance("Air")
        gaps.append(instance("Gap", thi=gap, medium=medium))
    stop = 1 + [row[0] for row in rows].index(0.0)
    sequence = instance("SequentialModel", ifcs=ifcs, gaps=gaps[:-1], stop_surface=stop)
    system = instance("SystemSpec", title="doublet", _dimensions="mm")
    return json.dumps({"optical_model": instance("", seq_model=sequence, system_spec=system, profile_dict=profiles)})


def optiland(rows=ROWS, kind="StandardGeometry", aperture=None, **more):
    """As Optiland saves it, but for what is of no use here. Without rims if the system's aperture is given."""
    z, surfaces = 0.0, [{"type": "ObjectSurface", "geometry": {"type": "Plane", "cs": {"z": float("-inf")}},
                         "material_post": {"type": "IdealMaterial", "index": 1.0, "absorp": 0.0}}]  # fmt: skip
    for number, (radius, gap, index, diameter) in enumerate([*rows, (0.0, 0.0, 1.0, 40.0)]):
        frame = {"cs": {"x": 0.0, "y": 0.0, "z": z, "rx": 0.0, "ry": 0.0, "rz": 0.0, "reference_cs": None}}
        shape = {"type": kind, "radius": radius, "conic": 0.0} | more if radius else {"type": "Plane"}
        glass = {"type": "AbbeMaterial", "abbe": 60.0} if index > 1 else {"type": "IdealMaterial"}
        rim = None if aperture else {"type": "RadialAperture", "r_max": diameter / 2, "r_min": 0.0}
        surfaces.append({"type": "Surface", "geometry": shape | frame, "material_post": glass | {"index": index},
                         "is_stop": radius == 0 and number < len(rows), "aperture": rim,
                         "interaction_model": {"is_reflective": False}})  # fmt: skip
        z += gap
    return json.dumps({"name": "doublet", "aperture": aperture, "surface_group": {"surfaces": surfaces}})


def pbrt(rows=ROWS):
    return "\n".join("  ".join(map(str, row)) for row in rows) + "\n"


def kolb(rows=ROWS):
    """The distance BEFORE each surface; the last reaches the stop."""
    gaps = [0.0, *(row[1] for row in rows[:-1])]
    return "\n".join(f"{row[0]} {gap} {row[2]} {row[3]}" for row, gap in zip(rows, gaps, strict=True))


def lens_of(folder, text, name="lens.txt"):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_lens(str(path))


@pytest.mark.parametrize(
    "text",
    [pbrt(), kolb(), optical_bench(), isetcam(), rayoptics(), optiland(), zemax(), zemax(unit="IN", size=25.4),
     zemax().encode("utf-16")],
    ids=["pbrt", "kolb", "optical_bench", "isetcam", "rayoptics", "optiland", "zemax", "zemax-inches", "zemax-utf16"],
)
def test_a_lens_is_the_same_in_each_format(tmp_path, text):
    lens = lens_of(tmp_path, text)
    optics = Optics.of(lens)
    expected = Optics.of(lens_of(tmp_path, pbrt(), "other.dat"))
    assert [row.curvature for row in lens.rows] == pytest.approx([1 / r if r else 0 for r, *_ in ROWS])
    assert [row.index for row in lens.rows] == [row[2] for row in ROWS]
    assert [row.rim for row in lens.rows] == pytest.approx([row[3] / 2 for row in ROWS])
    assert lens.stop == 3
    assert optics.focal_length == pytest.approx(expected.focal_length, rel=1e-12)


def test_columns_of_a_zoom_are_its_configurations(tmp_path):
    text = optical_bench().replace("\t5.0\t", "\td3\t") + "[variable distances]\nd3\t5\t9\nFocal Length\t83\t83\n"
    lens = lens_of(tmp_path, text)
    assert [gaps for _, gaps in lens.states] == [((2, 5.0),), ((2, 9.0),)]
    assert lens.claims == {"focal_length": 83.0}


@pytest.mark.parametrize(
    ("constants", "powers"),
    [("", (4, 6)), ("[constants]\nAsphericalA2\n", (2, 4)), ("[constants]\nAsphericalOddCount\n", (3, 4))],
)
def test_coefficients_of_aspheres_have_the_powers_that_the_file_says(tmp_path, constants, powers):
    lens = lens_of(tmp_path, optical_bench(extra=constants + "[aspherical data]\n1\t60\t-0.5\t1e-5\t2e-8\n"))
    assert lens.rows[0].conic == -0.5
    assert lens.rows[0].asphere == ((powers[0], 1e-5), (powers[1], 2e-8))


def test_polynomials_of_rayoptics_are_of_r_or_of_its_square(tmp_path):
    odd = lens_of(tmp_path, rayoptics(profile="RadialPolynomial", ec=0.5, coefs=[0.0, 0.0, 1e-5, 2e-7])).rows[0]
    even = lens_of(tmp_path, rayoptics(profile="EvenPolynomial", cc=-0.5, coefs=[0.0, 1e-5]), "even.roa").rows[0]
    assert (odd.conic, odd.asphere) == (-0.5, ((3, 1e-5), (4, 2e-7)))
    assert (even.conic, even.asphere) == (-0.5, ((4, 1e-5),))


def test_polynomials_of_optiland_are_of_r_or_of_its_square(tmp_path):
    odd = lens_of(tmp_path, optiland(kind="OddAsphere", coefficients=[0.0, 0.0, 1e-5, 2e-7], conic=-0.5)).rows[0]
    even = lens_of(tmp_path, optiland(kind="EvenAsphere", coefficients=[0.0, 1e-5]), "even.json").rows[0]
    assert (odd.conic, odd.asphere) == (-0.5, ((3, 1e-5), (4, 2e-7)))
    assert (even.conic, even.asphere) == (0.0, ((4, 1e-5),))


@pytest.mark.parametrize(
    ("kind", "value", "f_number"), [("imageFNO", 5.0, 5.0), ("EPD", 8.0, None), ("float_by_stop_size", 6.0, None)]
)
def test_the_stop_of_optiland_has_the_system_s_aperture(tmp_path, kind, value, f_number):
    lens = lens_of(tmp_path, optiland(aperture={"type": kind, "value": value}))
    optics = Optics.of(lens)
    if kind == "float_by_stop_size":
        assert lens.rows[3].rim == 3.0
    else:
        expected = f_number or optics.focal_length / value
        assert optics.widest_f_number == pytest.approx(expected, rel=1e-12)


def test_a_placeholder_is_not_the_index_of_a_catalog_glass(tmp_path):
    glass = zemax().replace("GLAS ___BLANK 1 0 1.52 60.0", "GLAS N-BK7 0 0 1.5 40.0")
    assert lens_of(tmp_path, glass).rows[0].index == 1.5168
    with pytest.raises(crc.InputError, match="surface 1 has the glass 'J-LAK14' without its index"):
        lens_of(tmp_path, glass.replace("N-BK7", "J-LAK14"))


def test_a_lens_in_water_keeps_the_medium_of_the_last_row(tmp_path):
    rows = [*ROWS[:2], (-150.0, 5.0, 1.336, 22.0), (0.0, 3.0, 1.336, 12.0)]
    assert Optics.of(lens_of(tmp_path, isetcam(rows))).rear.behind == 1.336


@pytest.mark.parametrize("ior", [0.0, 1.0, 1.5])
def test_a_plane_of_a_plate_is_not_the_stop(tmp_path, ior):
    """A filter behind the lens; the stop stands in air (0 and 1), or is cemented between two glasses (0 and 1.5)."""
    plate = [(0.0, 2.0, 1.5, 24.0), (0.0, 3.0, 1.0, 24.0)]
    stop = (0.0, 3.0, ior, 12.0)
    rows = [*ROWS[:3], stop, *plate] if ior <= 1 else [*ROWS[:3], plate[0], stop, plate[1]]
    lens = lens_of(tmp_path, isetcam(rows))
    assert lens.stop == rows.index(stop)
    assert [row.index for row in lens.rows] == [1.52, 1.62, 1.0, *((1.0, 1.5, 1.0) if ior <= 1 else (1.5, 1.5, 1.0))]
    inside = isetcam([*ROWS[:3], plate[0], (0.0, 3.0, 0.0, 12.0), plate[1]])
    assert [row.index for row in lens_of(tmp_path, inside).rows[3:]] == [1.5, 1.5, 1.0]
    glass = isetcam([*ROWS[:2], (0.0, 3.0, 1.0, 12.0), (-150.0, 5.0, 1.0, 22.0)])  # 1 in files whose stop is in glass
    assert lens_of(tmp_path, glass).rows[2].index == 1.62


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "none of the known formats"),
        ("hello", "none of the known formats"),
        (pbrt(ROWS[:3]), "0 rows of radius 0: one must be the stop"),
        (pbrt([(60.0, 6.0, 1.52, 240.0), *ROWS[1:]]), r"surface 1 has a clear radius of 120 mm .* is it a diameter\?"),
        (pbrt([(60.0, float("nan"), 1.52, 24.0), *ROWS[1:]]), "surface 1 has the gap nan"),
        (pbrt([(60.0, 6.0, 0.5, 24.0), *ROWS[1:]]), r"surface 1 has the index of refraction 0\.5"),
        (pbrt([(-60.0, 6.0, 1.52, 24.0), *ROWS[1:]]), "it must be positive"),
        (pbrt([*ROWS[:3], (0.0, 3.0, 1.0, 0.0)]), "the stop, has no radius"),
        (optical_bench().replace("60.0", "sixty"), "row '1' has the radius 'sixty'"),
        (optical_bench().replace("AS", "9"), "0 rows AS: one must be the stop"),
        (isetcam().replace("60.0", '"a"'), "surface 1 has the radius a"),
        (isetcam()[:-4], "none of the known formats|not JSON"),
        (zemax().replace("TYPE STANDARD\n  CURV", "TYPE COORDBRK\n  CURV", 1), "surface 1 is a COORDBRK"),
        (zemax().replace("___BLANK", "MIRROR", 1), "surface 1 is a MIRROR"),
        (zemax().replace("  STOP\n", ""), "no surface is the stop"),
        (zemax().replace("UNIT MM", "UNIT FEET"), "its unit is 'FEET'"),
        (rayoptics().replace("transmit", "reflect", 2), "surface 0 is a Spherical, reflect"),
        (rayoptics().replace('"stop_surface": 4', '"stop_surface": 9'), "its stop_surface is out of range"),
        (rayoptics().replace('"n": 1.52', '"gname": "X"'), "txt': surface 1 has the medium X without its index"),
        (rayoptics().replace("profile_id", "profile"), "its sequential model cannot be read"),
        (optiland().replace('"is_reflective": false', '"is_reflective": true', 1), "surface 1 is .*, reflecting"),
        (optiland().replace('"y": 0.0', '"y": 0.5', 1), "surface 1 is a StandardGeometry: only centered, refracting"),
        (optiland(kind="OddAsphere", coefficients=[1.0]), "surface 1 has a coefficient of r"),
        (optiland().replace('"index": 1.52', '"name": "X"'), "surface 1 has the medium X without its index"),
        (optiland().replace("true", "false"), "0 surfaces that are the stop"),
        (optiland(aperture={"type": "objectNA", "value": 0.1}), "the stop, has no radius"),
        (optiland().replace('"cs"', '"frame"'), "its group of surfaces cannot be read"),
        (isetcam().replace("60.0", "9" * 400), "a number that is too large"),
        (isetcam().replace("60.0", "[" * 9999 + "]" * 9999), "nested too deeply"),
    ],
    ids=range(29),
)
def test_what_is_no_lens_is_refused_in_one_line_that_names_the_file(tmp_path, text, words):
    with pytest.raises(crc.InputError, match=words) as caught:
        crc.camera("REAL_LENS", (32, 24), lens_file=str(_written(tmp_path, text)))
    assert "lens.txt" in str(caught.value)
    assert "\n" not in str(caught.value)


def _written(folder, text):
    path = folder / "lens.txt"
    path.write_text(text)
    return path


def test_a_file_that_is_missing_is_refused_with_the_lenses_of_the_library():
    with pytest.raises(crc.InputError, match=r"'tessar' cannot be read .* no lens of the library: .*tessar_100mm"):
        crc.camera("REAL_LENS", (32, 24), lens_file="tessar")


@pytest.mark.full
def test_damaged_files_end_in_a_lens_or_in_one_line(tmp_path):
    for text in (pbrt(), optical_bench(), isetcam(), rayoptics(), zemax()):
        for end in range(0, len(text), 17):
            for damaged in (text[:end], text[:end] + "x" + text[end:], text[:end] + "-" + text[end + 3 :]):
                with suppress(crc.InputError):  # any other error is a failure
                    crc.camera("REAL_LENS", (32, 24), lens_file=str(_written(tmp_path, damaged)))


@pytest.mark.parametrize(("path", "kind"), [("/dev/zero", "device"), (".", "directory")])
def test_what_is_no_file_is_refused_unread(path, kind):
    with pytest.raises(crc.InputError, match=f"it is a {kind}, not a file"):
        read_lens(path)
