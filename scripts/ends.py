"""How a script's process ends: with the script's own status; stopped or on a write error with one line at most.

Exit status 130: stopped by a signal. 2: standard output or a file cannot be used. 141: the reader of standard output is
gone; shells use this number for it, and no message is printed. Standard library only, and no syntax newer than
Python 3.6.
"""

import atexit
import os
import shutil
import signal
import sys
from contextlib import suppress

NAMES = "SIGINT", "SIGTERM", "SIGHUP"


def begin(script):
    """Set up the signals and the standard streams of a script's process; called before slow imports."""
    prog = os.path.basename(script)

    def leave(*_):
        _say(prog, "stopped; no unfinished files were left behind")
        try:
            sys.stdout.flush()
        finally:
            os._exit(130)  # also in the middle of an import

    listen(leave)
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest free number, before another file does
    if sys.stderr is None:
        sys.stderr = os.fdopen(2, "w")
    if sys.stdout is None:
        _say(prog, "standard output is closed: send it to a file, or to /dev/null")
        sys.exit(2)


def listen(handler):
    """Set the handler of the signals NAMES, except those that are ignored already, as under nohup."""
    for name in NAMES:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, handler)


def run(script, main):
    """Run ``main()``, flush standard output and return the exit status for ``sys.exit``.

    A process of ours that has imported bpy ends here: its libraries may abort at Python's own exit, as after fluids.
    """
    status = _ran(os.path.basename(script), main)
    bpy = sys.modules.get("bpy")
    if bpy is not None and not bpy.app.binary_path and (status is None or isinstance(status, int)):
        _leave(bpy.app.tempdir, status or 0)
    return status


def _leave(temporary, status):
    """End the process after the exit functions of Python, without those of libraries; remove Blender's own folder."""
    atexit._run_exitfuncs()
    for stream in sys.stdout, sys.stderr:
        with suppress(OSError, ValueError):
            stream.flush()
    if os.path.basename(os.path.normpath(temporary)).startswith("blender_"):  # not where Blender has none of its own
        shutil.rmtree(temporary, ignore_errors=True)
    os._exit(status & 0xFF)


def _ran(prog, main):
    """Run ``main()``, flush standard output and return the status."""
    try:
        try:
            status = main()
        except SystemExit as end:
            status = end.code
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        _say(prog, "stopped; no unfinished files were left behind")
        return 130
    except BrokenPipeError:
        _drop_output()
        return 141
    except OSError as error:
        _drop_output()
        where = repr(error.filename) if error.filename else "standard output"
        _say(prog, f"cannot use {where}: {error.strerror}; choose another place")
        return 2


def _drop_output():
    """Discard the buffered standard output: Python would try to write it again at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _say(prog, text):
    """Write a line to standard error; ignore errors."""
    with suppress(OSError):
        os.write(2, f"{prog}: {text}\n".encode("utf-8", "replace"))
