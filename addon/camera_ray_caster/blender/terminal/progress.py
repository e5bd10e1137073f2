"""Progress on standard error: a bar with the remaining time on a terminal, otherwise a line every EVERY seconds."""

import sys
from time import monotonic

COLUMNS = 30
EVERY = 10.0
"""Minimum number of seconds between lines without a terminal."""

LONG = 30.0
"""Number of seconds without an item after which the time so far is shown."""


class Progress:
    """Counter of ``total`` items. Items from an earlier run count, but do not affect the estimated remaining time."""

    def __init__(self, total: int, prog: str):
        self.total, self.prog = total, prog
        self.done = self.made = 0
        self.began = self.said = monotonic()

    def add(self, made: bool) -> None:
        """Count one more item and show the progress."""
        self.done += 1
        self.made += made
        now, left = monotonic(), ""
        if self.made:
            left = f", {_words((now - self.began) / self.made * (self.total - self.done))} left"
        text = f"{self.done} of {self.total}{left}"
        if sys.stderr.isatty():
            bar = "#" * (COLUMNS * self.done // self.total)
            end = "\n" if self.done == self.total else ""
            print(f"\r[{bar:{COLUMNS}}] {text}\033[K", end=end, file=sys.stderr, flush=True)
        elif now - self.said >= EVERY:
            self.said = now
            print(f"{self.prog}: {text}", file=sys.stderr, flush=True)

    def wait(self) -> bool:
        """Show the time so far if nothing was shown for LONG; return False. A function for ``signals.heard``."""
        now = monotonic()
        if now - self.said >= LONG:
            self.said = now
            over = "\r\033[K" if sys.stderr.isatty() else ""  # the bar
            text = f"{self.done} of {self.total}, {_words(now - self.began)} so far"
            print(f"{over}{self.prog}: {text}", file=sys.stderr, flush=True)
        return False


def _words(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"
