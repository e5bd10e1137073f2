"""Writes values of JSON's types as strict JSON."""

import json
import re


def as_text(value) -> str:
    """Return plain values as strict JSON: one line per entry, and one line per list of numbers."""
    text = json.dumps(value, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
    return re.sub(r"\[\n[-+.,\deE\s]+\]", lambda match: f"[{' '.join(match[0][1:-1].split())}]", text)
