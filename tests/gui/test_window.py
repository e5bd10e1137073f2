"""The add-on in a real Blender with a window: a user's walk through it, in scenarios. See walk.py for the inside.

BLENDER_GUI names a program that runs Blender with a window on a screen of its own. Where it is not set, Blender is
started on a virtual screen, if Blender, xvfb-run, xdotool and import (ImageMagick) are there.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OUTPUT = ROOT / "out" / "gui"
"""Where the screenshots are: below the project, which a Blender in a box of its own can see too."""

SHARES = (
    (
        "panel", "left_out", "stop", "ray_under_mouse", "search", "step_through_image", "cast_a_cube", "see_through",
        "ray_of_a_pixel", "export_colmap", "redraws_of_shapes", "shown_camera", "export_all", "slit_scan_movie",
        "quad_and_local_views", "undone", "saved_runs", "live_ends", "live_redraws", "live_look", "live_mishaps",
    ),
    (
        "stop_samples", "show_result", "model_gallery", "step_through", "lens_in_view", "examples", "notes_stay",
        "redraws_of_monkeys", "set_frame", "marks", "cast_all", "slit_scan_preview", "lecture", "every_kind",
        "live_picture", "live_shadings", "left_however", "own_view",
    ),
    (
        "no_camera", "load_while_casting", "overlay", "viewport", "cycles", "camera_settings", "told", "results_stay",
        "redraws_of_models", "other_engine", "click_seen", "drag_a_ray", "cast_all_by_cycles", "scanned_points",
        "drag_x_before_a_class", "autosaved", "linked_cameras", "by_hand", "saved_views", "live_edges",
        "disable",
    ),
)  # fmt: skip
"""Of three Blenders at once, which mostly wait: of about equal times, which the logs beside the screenshots tell."""
SCENARIOS = sum(SHARES, ())
SEEDS = "1", "2", "3", "4"
"""Of random acts, 250 each: see random_acts.py."""
SIZE = "1400x900"
LIMIT = 3600
"""Seconds for the whole walk: six times what it takes on two idle cores without a graphics card."""


def program():
    """The words that start Blender with a window, or None and what is missing."""
    if "BLENDER_GUI" in os.environ:
        return shlex.split(os.environ["BLENDER_GUI"]), ""
    blender = os.environ.get("BLENDER", "blender")
    missing = [name for name in (blender, "xvfb-run", "xdotool", "import") if shutil.which(name) is None]
    if missing:
        return None, f"no window: {', '.join(missing)} not found; set BLENDER_GUI, or install them"
    width, height = SIZE.split("x")
    screen = ["xvfb-run", "--auto-servernum", "--server-args", f"-screen 0 {SIZE}x24"]
    return [*screen, blender, "--gpu-backend", "opengl", "-p", "0", "0", width, height], ""


@pytest.fixture(scope="module")
def results():
    """How each scenario ended, by name: "ok" or a traceback."""
    with ThreadPoolExecutor(len(SHARES)) as pool:
        walks = [pool.submit(walked, OUTPUT / str(first), *names) for first, names in enumerate(SHARES)]
        return {name: end for walk in walks for name, end in walk.result().items()}


def walked(folder, *names):
    """Walk through scenarios of these names; return how each ended. The screenshots are in a folder."""
    words, missing = program()
    if words is None:
        pytest.skip(missing)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    walk = ["--factory-startup", "--python", "tests/gui/walk.py", "--", "blend_scenes"]
    environment = {"BLENDER_USER_RESOURCES": str(folder / "profile"), "LIBGL_ALWAYS_SOFTWARE": "1"}
    with (folder / "log.txt").open("w") as log:
        subprocess.run(
            [*words, *walk, str(folder), *names],
            cwd=ROOT,
            env=os.environ | environment,
            stdout=log,
            stderr=subprocess.STDOUT,
            timeout=LIMIT,
        )
    result = folder / "result.json"
    log_text = (folder / "log.txt").read_text()
    assert result.is_file(), f"Blender ended before its time:\n{log_text}"
    assert "Traceback" not in log_text, log_text
    return json.loads(result.read_text())


@pytest.mark.parametrize("name", SCENARIOS)
def test_scenario(results, name):
    assert results[name] == "ok", results[name]


def test_every_scenario_is_named_here():
    tuples = (path.read_text() for path in Path(__file__).parent.glob("*scenarios.py"))
    written = re.findall(r"SCENARIOS = [^(]*\(([^)]*)\)", "".join(tuples))
    assert set(re.findall(r"\b[a-z]\w+", " ".join(written))) >= set(SCENARIOS)
    assert len(set(SCENARIOS)) == len(SCENARIOS)


@pytest.mark.hostile
@pytest.mark.parametrize("seed", SEEDS)
def test_random_acts_end_in_no_traceback(seed):
    assert walked(OUTPUT.with_name("gui_acts"), seed) == {seed: "ok"}
