"""How the process of a script ends: with a status and at most one line on standard error, never with a traceback.

130: stopped. 2: what it prints, or a file of its own, cannot be written. 141: nobody reads what it prints any more, for
which shells have that number and no words. Standard library only, and no syntax newer than Python 3.6.
"""

import os
import signal
import sys
from contextlib import suppress

NAMES = "SIGINT", "SIGTERM", "SIGHUP"


def begin(script):
    """See to the signals and the standard streams of a script's process: before the imports that take long."""
    prog = os.path.basename(script)

    def leave(*_):
        _say(prog, "stopped; what was under way has left nothing")
        try:
            sys.stdout.flush()
        finally:
            os._exit(130)  # whatever library is being imported

    listen(leave)
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the lowest free number: the next file that is opened would be taken for it
    if sys.stderr is None:
        sys.stderr = os.fdopen(2, "w")
    if sys.stdout is None:
        _say(prog, "standard output is closed: send it to a file, or to /dev/null")
        sys.exit(2)


def listen(handler):
    """Let a handler hear what asks a process to end, but what is ignored already, as under nohup."""
    for name in NAMES:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, handler)


def run(script, main):
    """Return the exit status of ``main()``, for ``sys.exit``; what it has printed is written by then."""
    prog = os.path.basename(script)
    try:
        try:
            status = main()
        except SystemExit as end:
            status = end.code
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        _say(prog, "stopped; what was under way has left nothing")
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
    """Send what standard output still holds nowhere: Python would try again at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _say(prog, text):
    """Write a line to standard error, if it takes it."""
    with suppress(OSError):
        os.write(2, f"{prog}: {text}\n".encode("utf-8", "replace"))
