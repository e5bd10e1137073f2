"""Progress of many pictures: on a terminal one line that is rewritten, as tqdm's; elsewhere a line every EVERY seconds.

Both have pictures a minute, the remaining time and the failures so far. ``--log FILE`` has the lines, too.
"""

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from time import monotonic

from ...core.records import InputError
from ..process import signals
from .jobs import Outcome
from .options import warn

COLUMNS = 30
EVERY = 30.0
"""Minimum number of seconds between lines without a terminal."""

LONG = 30.0
"""Number of seconds without an item after which the time so far is shown."""


MOST_FAILURES = 10
"""Number of pictures that fail before any succeeds after which a run ends."""


class Progress:
    """Counter of ``total`` items. Items from an earlier run count, but do not affect rate and remaining time."""

    def __init__(self, total: int, prog: str, log: Path | None = None, every: float = EVERY):
        self.total, self.prog, self.log, self.every = total, prog, log, every
        self.done = self.made = self.failed = 0
        self.began = self.said = monotonic()

    def add(self, made: bool, failed: bool = False) -> None:
        """Count one more item and show the progress."""
        self.done += 1
        self.made += made
        self.failed += failed
        now, tries = monotonic(), self.made + self.failed
        elapsed = now - self.began
        left = _words(elapsed / tries * (self.total - self.done)) if tries else "?"
        rate = f"{self.made / elapsed * 60:.3g}" if self.made and elapsed > 0 else "?"
        last = self.done == self.total
        if sys.stderr.isatty():
            bar = f"{100 * self.done // self.total:3}%|{'#' * (COLUMNS * self.done // self.total):{COLUMNS}}|"
            text = f"{self.done}/{self.total} [{_words(elapsed)}<{left}, {rate} pictures/min, {self.failed} failed]"
            print(f"\r{bar} {text}\033[K", end="\n" if last else "", file=sys.stderr, flush=True)
        if now - self.said >= self.every or last:
            self.said = now
            remains = f", {left} left" if tries else ""
            line = f"{rate} pictures a minute, {self.failed} failed, {self.done} of {self.total}{remains}"
            if not sys.stderr.isatty() and elapsed >= self.every:
                print(f"{self.prog}: {line}", file=sys.stderr, flush=True)
            self.write(line)

    def write(self, line: str) -> None:
        """Append a line to the log. Raises InputError if it cannot be written."""
        if self.log is None:
            return
        try:
            with self.log.open("a", encoding="utf-8") as file:
                file.write(f"{self.prog}: {line}\n")
        except OSError as error:
            raise InputError(f"cannot write the log {str(self.log)!r}: {error.strerror}") from error

    def say(self, line: str) -> None:
        """Print a line, in place of the bar, and log it."""
        over = "\r\033[K" if sys.stderr.isatty() else ""
        print(f"{over}{self.prog}: {line}", file=sys.stderr, flush=True)
        self.write(line)

    def wait(self) -> bool:
        """Show the time so far if nothing was shown for LONG; return False. A function for ``signals.heard``."""
        now = monotonic()
        if now - self.said >= LONG:
            self.said = now
            self.say(f"{self.done} of {self.total}, {_words(now - self.began)} so far")
        return False


def follow(
    outcomes: Iterable[Outcome], count: int, prog: str, log: Path | None = None, every: float = EVERY
) -> Iterator[Outcome]:
    """Yield outcomes as they come; show the progress of several jobs or of a long one, and print each warning once and
    each failure. Without a terminal there are at least ``every`` seconds between two lines. Raises InputError if the
    first MOST_FAILURES jobs fail.
    """
    progress, warned = Progress(count, prog, log, every), set()
    with signals.heard(progress.wait):
        for outcome in outcomes:
            for line in outcome.warnings:
                if line not in warned:
                    warn(prog, line)
                    warned.add(line)
            if outcome.failure:
                progress.say(outcome.failure)
            if count > 1:
                progress.add(outcome.made, bool(outcome.failure))
            if progress.failed == progress.done == MOST_FAILURES:
                raise InputError(f"the first {MOST_FAILURES} pictures failed: see their errors above")
            yield outcome


def _words(seconds: float) -> str:
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}"
