"""A user's walk through the add-on in a window: run by a Blender, told in scenarios. See test_window.py.

Arguments: the folder of the example scenes, a folder for screenshots and for result.json; then
the names of scenarios, all without; a number is the seed of random acts.
"""

import json
import os
import subprocess
import sys
import time
import traceback
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE.parents[1] / "scripts")]
import make_zip  # noqa: E402
from random_acts import acts  # noqa: E402
from scenarios import MODULE, SCENARIOS  # noqa: E402
from user import TICK, User  # noqa: E402

FAILURES = (
    AssertionError, ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError,
    subprocess.SubprocessError,
)  # fmt: skip
"""What ends a scenario, but not the walk."""
SMOOTH = "overlay", "scanned_points", "live_redraws"
"""Scenarios with Blender's default antialiasing, since they look at thin lines or take the time of what a user sees. By
software it draws each change several times, so all others have none.
"""


def install(folder):
    """Build the zip and install it as a user does."""
    archive = str(make_zip.build(folder))
    bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    assert MODULE in bpy.context.preferences.addons


def prepare():
    """Set what a test needs of the preferences; nothing is saved."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.show_tooltips = False  # one comes and goes, drawn twice, wherever the mouse rests
    preferences.view.render_display_type = "AREA"  # there is no window manager for a second window
    preferences.view.filebrowser_display_type = "SCREEN"
    preferences.use_preferences_save = False


def tell(user, scenes, results, wanted):
    """Yield through the scenarios, and note how each ended; its seconds are printed."""
    for name in wanted or SCENARIOS:
        bpy.context.preferences.system.viewport_aa = "8" if name in SMOOTH else "OFF"
        began, used = time.monotonic(), time.process_time()
        try:
            yield from (SCENARIOS[name] if name in SCENARIOS else acts(int(name)))(user, scenes)
            results[name] = "ok"
        except FAILURES:
            results[name] = traceback.format_exc()
            user.screenshot(f"failure_{name}")
        seconds, used = time.monotonic() - began, time.process_time() - used
        print(f"scenario {name}: {seconds:.0f} s, {used:.0f} s of the processors", flush=True)


def main(scenes, folder, *wanted):
    """Install, then tell the scenarios from a timer; Blender ends with the last."""
    folder = Path(folder).resolve()
    prepare()
    install(folder)
    results = {}
    steps = tell(User(folder), Path(scenes).resolve(), results, wanted)

    def tick():
        for _ in steps:
            return TICK
        (folder / "result.json").write_text(json.dumps(results, indent=1))
        sys.stdout.flush()
        os._exit(0)  # at once: no question about unsaved changes

    bpy.app.timers.register(tick, first_interval=1.0, persistent=True)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
