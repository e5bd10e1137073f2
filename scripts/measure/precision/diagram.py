"""The work-precision diagram and its tables."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from .arithmetic import METHODS

COLORS = {"float32 textbook": "#d1495b", "float64 textbook": "#66a182", "float64 robust": "#2e4057"}
OTHERS = ("#2e4057", "#d1495b", "#66a182")
FLOOR = 1e-17
LABELS = {"everyday: spheres and planes around": "everyday: spheres and planes"}
TITLES = {
    "samples": ("Lens and hole: samples", "error of a pixel, of white (rms)"),
    "inverse": ("Inverse of a lens: Newton steps", "worst error, rad"),
    "verification": ("Verification: what of a fault of ½ px is not seen", "px"),
    "time": ("Slit scan: tolerance asked for, and evaluations", "worst error, px"),
}


def draw(points, stem: Path) -> None:
    """Write stem.svg and stem.png: error over time, log-log, with a curve or markers per method."""
    plt.rcParams |= {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "svg.fonttype": "none"}
    present = [family for family in TITLES if any(p.family == family for p in points)]
    pairs = [present[i : i + 2] for i in range(0, len(present), 2)]
    rows = [[pair[0], pair[-1]] for pair in pairs]
    scenes = [p for p in points if p.family == "arithmetic"]
    if scenes:
        rows.insert(0, ["scenes", "scenes"])
    heights = [1.35 if row[0] == "scenes" else 1 for row in rows]
    figure, axes = plt.subplot_mosaic(
        rows, figsize=(10, 3.3 * sum(heights)), height_ratios=heights, layout="constrained"
    )
    if scenes:
        _scenes(axes["scenes"], scenes)
    for family in present:
        _curves(axes[family], [p for p in points if p.family == family], *TITLES[family])
    for axis in figure.axes:
        low, high = axis.get_xlim()
        if high < 30 * low:  # too few powers of ten on the axis
            axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axis.xaxis.set_minor_formatter(NullFormatter())
    for suffix, options in ((".svg", {"metadata": {"Date": None}}), (".png", {"dpi": 100})):
        figure.savefig(stem.with_suffix(suffix), **options)
    plt.close(figure)


def _scenes(axis, points):
    scenes = list(dict.fromkeys(p.scene for p in points))
    for method in METHODS:
        of_method = [p for p in points if p.method == method]
        x, y = [p.seconds * 1e3 for p in of_method], [max(p.worst_error, FLOOR) for p in of_method]
        marker = "o" if method.endswith("robust") else "s"
        axis.scatter(x, y, s=110, color=COLORS[method], marker=marker, label=method, edgecolors="white", zorder=3)
        for p, a, b in zip(of_method, x, y, strict=True):
            number = scenes.index(p.scene) + 1
            axis.annotate(number, (a, b), ha="center", va="center", fontsize=7, color="white", zorder=4)
    axis.axhline(2.0**-24, color="0.6", lw=0.8, ls="--")
    axis.annotate("rounding of a stored float32", (0, 2.0**-24), (4, 12), xycoords=("axes fraction", "data"),
                  textcoords="offset points", fontsize=7, color="0.4")  # fmt: skip
    axis.set(xscale="log", yscale="log", title="Arithmetic: a number a scene; error 1: a hit or miss is wrong",
             xlabel="ms per million rays", ylabel="worst error, of the distance")  # fmt: skip
    axis.legend(frameon=False, loc="lower left", bbox_to_anchor=(1.0, 0.62))
    numbered = "\n".join(f"{i:2}  {LABELS.get(scene, scene)}" for i, scene in enumerate(scenes, 1))
    axis.annotate(numbered, (1.02, 0.58), xycoords="axes fraction", va="top", fontsize=8, linespacing=1.5)
    axis.grid(alpha=0.25)


def _curves(axis, points, title, label):
    use_median = points[0].family == "samples"
    for color, method in zip(OTHERS, dict.fromkeys(p.method for p in points), strict=False):
        of_method = [p for p in points if p.method == method]
        y = [max(p.median_error if use_median else p.worst_error, FLOOR) for p in of_method]
        axis.plot([p.seconds * 1e3 for p in of_method], y, "o-", ms=4, color=color, label=method)
        for p, error in zip(of_method, y, strict=True):
            position = p.seconds * 1e3, error
            axis.annotate(p.scene, position, (5, 4), textcoords="offset points", fontsize=7, color=color)
    axis.set(xscale="log", yscale="log", title=title, ylabel=label, xlabel="ms per million pixels")
    axis.margins(x=0.15, y=0.12)
    axis.legend(frameon=False, fontsize=8)
    axis.grid(alpha=0.25)


def table(points) -> str:
    """Return the arithmetic points as a Markdown table: median / worst relative error, and ms per million rays."""
    if all(p.family != "arithmetic" for p in points):
        return ""
    lines = ["| scene | " + " | ".join(METHODS) + " | cheapest below 1e-12 |", "|---|" + "---|" * (len(METHODS) + 1)]
    for scene in dict.fromkeys(p.scene for p in points if p.family == "arithmetic"):
        by_method = {p.method: p for p in points if p.scene == scene and p.family == "arithmetic"}
        good = [p for p in by_method.values() if not p.wrong and p.worst_error < 1e-12]
        best = min(good, key=lambda p: p.seconds).method if good else "none"
        lines.append(f"| {scene} | " + " | ".join(_cell(by_method[m]) for m in METHODS) + f" | {best} |")
    return "\n".join(lines)


def other_families(points) -> str:
    """Return all other points as a Markdown table."""
    if all(p.family == "arithmetic" for p in points):
        return ""
    lines = ["| method | effort | median error | worst error | ms per million | spread |", "|---|---|---|---|---|---|"]
    lines += [
        f"| {p.method} | {p.scene} | {p.median_error:.1e} {p.unit} | {p.worst_error:.1e} | {p.seconds * 1e3:.0f} | "
        f"{p.spread:.1f} |"
        for p in points
        if p.family != "arithmetic"
    ]
    return "\n".join(lines)


def _cell(p) -> str:
    error = f"**{p.wrong} of {p.compared} wrong**" if p.wrong else f"{p.median_error:.0e} / {p.worst_error:.0e}"
    return f"{error}, {p.seconds * 1e3:.0f} ms"
