"""How far a long run is, on standard error: a bar with the time left on a terminal, a line now and then elsewhere."""

import sys
from time import monotonic

COLUMNS = 30
EVERY = 10.0
"""Seconds between lines where there is no terminal."""


class Progress:
    """Counts what is done of ``total``. What was there before counts, but says nothing of the time that is left."""

    def __init__(self, total: int, prog: str):
        self.total, self.prog = total, prog
        self.done = self.made = 0
        self.began = self.said = monotonic()

    def add(self, made: bool) -> None:
        """Count one more, and show it."""
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


def _words(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"
