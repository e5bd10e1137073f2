"""A process that tries one input after the other: a line of JSON in, a line of JSON out.

    python -m tests.hostile.worker LOG

Each input goes the way of a user's file: it is saved, opened by the command and cast, in a folder of its own. A crash
writes where Python was into LOG; an exception that nobody handles ends the process.
"""

import contextlib
import faulthandler
import io
import json
import os
import pickle
import runpy
import sys
import tempfile
from pathlib import Path

from .inputs import make
from .inputs.parts import Hostile, small_scene
from .judge import check_cast, check_export, check_refusal, check_set

EXPORTED = "colmap", "opencv", "stmap"
"""Formats besides JSON, which every camera is exported to, that take turns: with poses and lenses as others say them,
of two lenses.
"""

SETS = 4
"""Of so many scenes of one sort one is made a data set, too, which takes as long as all else that is tried of it."""

known_cameras: set[bytes] = set()
"""Records of cameras that this process has cast in a scene that was otherwise the same: a value beyond a range is
read as its end, a word as the default. Such a file is verified, which reads it, and not cast and exported once more:
one setting in five.
"""

RIGHT = "warning: scripts in the file were not run", "warning: Freestyle draws its lines after the cast"
"""How warnings begin that are right of some inputs."""

ROOT = Path(__file__).resolve().parents[2]


def run(command, words, folder):
    """Run a command in a folder; return its exit status and what Python wrote to standard output and error.

    What Blender's own libraries write there, such as libpng, is passed over, and the warnings RIGHT.
    """
    folder.mkdir()
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            status = command(words)
        except SystemExit as ended:
            status = ended.code
    lines = [line for line in errors.getvalue().splitlines(keepends=True) if not any(words in line for words in RIGHT)]
    return status, out.getvalue(), "".join(lines)


def of_add_on(name):
    """Return a command of the add-on's terminal."""
    from camera_ray_caster.blender.terminal import commands

    return lambda words: commands.main(name, words, f"{name}.py")


def of_script(name):
    """Return a script as a command."""

    def command(words):
        import ends  # beside the scripts

        sys.argv[:] = [f"{name}.py", *words]
        ends._leave = lambda temporary, status: None  # this process goes on
        runpy.run_path(str(ROOT / "scripts" / f"{name}.py"), run_name="__main__")
        return 0

    return command


def outcome(hostile: Hostile, file: Path, folder: Path, number: int) -> str:
    """Return "cast" or "refused" for the input of a number; raise AssertionError for anything else."""
    if hostile.script:
        check_refusal(*run(of_script(hostile.script), list(hostile.words), folder / "script"), folder / "script")
        return "refused"
    if hostile.command:
        words = [str(file), *hostile.words]
        check_refusal(*run(of_add_on(hostile.command), words, folder / "command"), folder / "command")
        return "refused"
    record = camera_in_memory() if hostile.camera_alone else b""
    if record in known_cameras:
        verify = run(of_add_on("verify"), [str(file)], folder / "verify")
        assert (verify[0], verify[2]) == (0, ""), f"cast before, but not verified: {verify[2] or verify[1]}"
        return "cast"
    cast = run(of_add_on("cast"), [str(file), "--output", "out", *hostile.words], folder / "cast")
    (check_refusal if cast[0] == 2 else check_cast)(*cast, folder / "cast")
    verify = run(of_add_on("verify"), [str(file), *hostile.words], folder / "verify")
    if verify[0] == 2:
        assert cast[0] == 2 or hostile.words, f"cast, but not verified: {verify[2]}"
        check_refusal(*verify, folder / "verify")
    else:
        assert verify[0] == 0, f"verify has status {verify[0]}: {verify[2] or verify[1]}"
        assert verify[2] == "", f"verify says {verify[2]}"
    if number % SETS == 0 and not hostile.words:
        check_annotated(cast[0], folder, file)
    for key in () if hostile.words else ("json", EXPORTED[number % len(EXPORTED)]):
        export = run(of_add_on("export"), [str(file), "--format", key, "--output", "out"], folder / key)
        if export[0] == 2:
            check_refusal(*export, folder / key)
            assert key != "json" or verify[0] == 2, f"verified, but not exported: {export[2]}"
        else:
            check_export(*export, folder / key)
    if cast[0] == 2:
        return "refused"
    if record:
        known_cameras.add(record)
    return "cast"


def camera_in_memory() -> bytes:
    """Return all that the add-on reads of the camera that is about to be saved, or b"" if it is refused."""
    import bpy

    from camera_ray_caster.blender.read.camera_fields import camera_record
    from camera_ray_caster.core.records import InputError

    try:
        return pickle.dumps(camera_record(bpy.context.scene.camera, bpy.context.evaluated_depsgraph_get()))
    except InputError:
        return b""


def check_annotated(status: int, folder: Path, file: Path) -> None:
    """A data set with flow and annotations is made of what is cast, or refused."""
    words = [str(file), "--frames", "1:1", "--passes", "depth,flow_hidden", "--keypoints", "ALL", "--output", "out"]
    made = run(of_add_on("dataset"), words, folder / "set")
    if made[0] == 2:
        check_refusal(*made, folder / "set")
    else:
        assert status == 0, "not cast, but in a data set"
        check_set(*made, folder / "set")


def tried(kind, number) -> dict:
    """Return what came of an input."""
    import bpy

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as directory:
        made, folder = Path(directory) / "made", Path(directory) / "run"
        made.mkdir()
        folder.mkdir()
        small_scene()
        hostile = make(kind, number, made)
        file = hostile.file
        if file is None:
            file = made / "hostile.blend"
            bpy.ops.wm.save_as_mainfile(filepath=str(file), copy=True)
        try:
            came = outcome(hostile, file, folder, number)
            assert hostile.scripts is None or not hostile.scripts.exists(), "a script in the file ran"
            return {"what": hostile.what, "outcome": came, "said": ""}
        except AssertionError as error:
            return {"what": hostile.what, "outcome": "broken", "said": str(error)}


def main():
    """Answer until the input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    with open(sys.argv[1], "w") as log:
        faulthandler.enable(log)
        import bpy

        import camera_ray_caster

        bpy.ops.wm.read_factory_settings(use_empty=True)
        camera_ray_caster.register()
        for line in sys.stdin:
            print(json.dumps(tried(*json.loads(line))), file=answers, flush=True)
        camera_ray_caster.unregister()
    os._exit(0)  # bpy may hang at its end after many renders


if __name__ == "__main__":
    main()
