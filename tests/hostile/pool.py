"""A worker as the tests use it: where it crashes or hangs, that is what came of its input, and another one starts."""

import json
import os
import select
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 60
"""Seconds that an input may take, on a busy machine."""

OPENING = "in open_file"
"""The line of our own code from which Blender opens a file."""


class Pool:
    """One process at a time."""

    def __init__(self, folder):
        self.log, self.told, self.process = folder / "crash.txt", folder / "errors.txt", None

    def _start(self):
        words = [sys.executable, "-m", "tests.hostile.worker", str(self.log)]
        # this checkout's add-on, not that which pip has installed; scripts find what lies beside them
        places = os.environ | {"PYTHONPATH": os.pathsep.join(str(ROOT / name) for name in ("addon", "scripts"))}
        pipes = dict.fromkeys(("stdin", "stdout"), subprocess.PIPE)
        with self.told.open("w") as file:  # a pipe that nobody reads would stop Blender, which says much about drivers
            self.process = subprocess.Popen(words, cwd=ROOT, env=places, text=True, stderr=file, **pipes)

    def tried(self, kind, number):
        """What came of an input: a dict with ``what`` it is, the ``outcome`` and what was ``said``.

        A crash counts where a new process crashes, too: an earlier file may have spoiled Blender's memory.
        """
        outcome = self._tried(kind, number)
        return self._tried(kind, number) if outcome["outcome"] == "crashed" else outcome

    def _tried(self, kind, number):
        if self.process is None:
            self._start()
        self.process.stdin.write(json.dumps([kind, number]) + "\n")
        self.process.stdin.flush()
        if select.select([self.process.stdout], [], [], PATIENCE)[0]:
            answer = self.process.stdout.readline()
            if answer:
                return json.loads(answer)
            return self._crashed()
        self.process.send_signal(signal.SIGABRT)  # the log then says where
        return self._crashed() | {"outcome": "hung"}

    def _crashed(self):
        self.process.wait(10)
        errors, log = self.told.read_text(errors="replace")[-2000:], self.log.read_text()
        self.process = None
        stack = log.partition("Current thread")[2].partition("\n\n")[0].splitlines()
        ours = next((line for line in stack if "camera_ray_caster" in line or "tests/hostile" in line), "")
        output = errors + "\n".join([*log.splitlines()[:1], *stack[:12]])
        return {"what": "", "outcome": "opening crashed" if OPENING in ours else "crashed", "said": output}

    def close(self):
        """End the process."""
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait(30)
