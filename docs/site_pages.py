"""An extension of Sphinx: pages that are made from the code when the site is built, and docstrings as reStructuredText.

The pages are docs/cameras/ and docs/api/; no version of them is kept.
"""

import ast
import html
import re
import shutil
from pathlib import Path

import model_pages  # in this folder

import camera_ray_caster as crc
from camera_ray_caster.core.casting import passes as declared

ROOT = Path(__file__).resolve().parents[1]
CONTRACTS = {
    "Cameras": ("core.cameras.model", "core.cameras.parts.settings"),
    "Shapes": ("core.shapes.kind",),
    "Exports": ("core.exports.format",),
    "Records": ("core.records", "core.shape_records", "core.scene"),
    "Recorded formulas": ("core.maths.recording.record",),
}
"""Modules of core with what a model, a kind of shape or a format of one's own has to give."""
CONTENTS = {
    "Tutorials": (
        "tutorials/walks", "tutorials/data_set", "tutorials/lesson", "tutorials/camera_of_your_own",
        "tutorials/strange_camera_in_cycles", "tutorials/real_lens", "tutorials/behind_glass",
    ),
    "Look up": (
        "cameras/index", "conventions", "python", "terminal", "live", "api/index", "formats",
        "/addon/camera_ray_caster/core/programs/README", "/addon/camera_ray_caster/blender/read/README",
        "/blend_scenes/README",
    ),
    "Measured": (
        "accuracy", "limits", "scale", "/scripts/README", "measurements/tracers", "measurements/window",
        "measurements/precision",
    ),
    "How it is built": ("promises", "/addon/README", "/CONTRIBUTING", "/CHANGELOG", "README <../README>"),
}  # fmt: skip
"""The pages in the sidebar, by caption, as the start page names them."""
TABLE = re.compile(r"\(((?:\.\./)*)addon/camera_ray_caster/core/cameras/README\.md\)")
"""A link to the table of models: here the models have pages."""
LESSON = re.compile(r"\[([^\]]+)\]\(((?:\.\./)*(?:docs/)?lesson/index\.html[^)]*)\)")
"""A link to the lesson, which is no page of Sphinx: it stands in the site where it stands in docs/."""
START = '<!DOCTYPE html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url=docs/index.html">'
START += '<title>Camera Ray Caster</title><a href="docs/index.html">Camera Ray Caster</a>\n'


def setup(app):
    """Add the makers of pages to Sphinx."""
    app.connect("builder-inited", make_pages)
    app.connect("source-read", adapt)
    app.connect("autodoc-process-docstring", as_rest)
    app.connect("html-page-context", lead_back)
    app.connect("build-finished", add_files)
    return {"parallel_read_safe": True, "version": crc.__version__}


def make_pages(app) -> None:
    """Write the pages that are made from the code."""
    model_pages.write(ROOT, ROOT / "docs" / "cameras")
    api = ROOT / "docs" / "api"
    api.mkdir(exist_ok=True)
    for name, text in {"index": door(), "contracts": contracts(), "passes": passes()}.items():
        (api / f"{name}.md").write_text(text, encoding="utf-8")


def adapt(app, page: str, source: list[str]) -> None:
    """Add the contents to the start page, and lead links to the table of models to the models' pages."""
    source[0] = TABLE.sub(r"(\1docs/cameras/index.md)", source[0])
    source[0] = LESSON.sub(lambda found: f'<a href="{html.escape(found[2])}">{found[1]}</a>', source[0])
    if page == "docs/index":
        for title, pages in CONTENTS.items():
            source[0] += "\n".join(("\n```{toctree}", ":hidden:", f":caption: {title}", *pages, "```\n"))
    elif page == "docs/formats":
        source[0] += model_pages.writers()


def door() -> str:
    """Return the page of the public names, in the groups that the package's docstring has."""
    text = (
        "# Python reference\n\n```{toctree}\n:hidden:\npasses\ncontracts\n```\n\n"
        "All names of `import camera_ray_caster as crc`. `help(crc)` has them, too. "
        "[What each pass stores](passes.md), [contracts for code of your own](contracts.md).\n"
    )
    groups = re.findall(r"^([A-Z].+)\n    ([\w., ;:()\n]+?)(?=\n\S|\n\n)", crc.__doc__, re.MULTILINE)
    grouped = {title: [name for name in re.findall(r"\w+", names) if name in crc.__all__] for title, names in groups}
    grouped["Classes"] = list(crc.__all__)  # all that have no other place
    seen: set[str] = set()
    for title, names in grouped.items():
        members = "".join(directive(name) for name in names if name not in seen)
        text += f"\n## {title}\n\n```{{eval-rst}}\n.. currentmodule:: camera_ray_caster\n{members}```\n"
        seen.update(names)
    return text


def directive(name: str) -> str:
    """Return the directive that documents a public name."""
    module, _, other = crc._MODULE_OF.get(name, "").partition(":")
    if module.startswith(".blender"):
        return from_source(name, module, other or name)
    if isinstance(getattr(crc, name), type):
        return f".. autoclass:: {name}\n   :members:\n   :exclude-members: __init__\n"
    return f".. autofunction:: {name}\n"


def from_source(name: str, module: str, defined: str) -> str:
    """Return the directive of a function that cannot be imported without Blender, from its source."""
    place = Path(crc.__file__).parent.joinpath(*module.strip(".").split("."))
    files = place.glob("*.py") if place.is_dir() else [place.with_suffix(".py")]
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in files]
    (found,) = (one for tree in trees for one in tree.body if isinstance(one, ast.FunctionDef) and one.name == defined)
    lines = rest_of((ast.get_docstring(found) or "").splitlines())
    return f".. function:: {name}({ast.unparse(found.args)})\n\n" + "".join(f"   {line}\n" for line in lines) + "\n"


def contracts() -> str:
    """Return the page of modules for code of one's own."""
    text = "# Contracts\n\nWhat a camera model, a kind of shape or an export format of your own has to give.\n"
    for title, modules in CONTRACTS.items():
        members = "".join(f".. automodule:: camera_ray_caster.{one}\n   :members:\n" for one in modules)
        text += f"\n## {title}\n\n```{{eval-rst}}\n{members}```\n"
    return text


def passes() -> str:
    """Return the page of the passes."""
    rows = "".join(
        f"| `{name}` | {one.channels or 1} | {'`dtype`' if one.dtype is None else one.dtype.__name__} | {one.text} |\n"
        for name, one in declared.PASSES.items()
    )
    text = model_pages.as_markdown((declared.__doc__ or "").partition("\n\n")[2])
    return (
        f"# Passes\n\n{text}\n\n`dtype` is that of the cast.\n\n| pass | channels | type | |\n|---|---|---|---|\n{rows}"
    )


def as_rest(app, what, name, thing, options, lines: list[str]) -> None:
    """Turn a docstring into reStructuredText, in place."""
    lines[:] = [] if lines[:1] and lines[0].startswith("Alias for field number") else rest_of(lines)


def rest_of(lines: list[str]) -> list[str]:
    """Return a docstring as reStructuredText: "name: text" becomes a definition, and the signs of formulas are kept."""
    found, last = [], ""  # last: what the line before was: "" for a blank one, or for the beginning
    for line in lines:
        parts = re.split(r"(``.+?``)", line)
        parts[::2] = [re.sub(r"(?<!^)\*|[|`]|_\b", r"\\\g<0>", part) for part in parts[::2]]
        text = "".join(parts)
        begins = re.match(r"([a-z_]\w*(?:, [a-z_]\w*)*): (.+)$", text) if last != "text" else None
        if begins:
            found += ["", f"**{begins[1]}**", f"    {begins[2]}"]
        elif last == "definition" and line.strip() and not line.startswith("Raises "):
            found.append(f"    {text.lstrip()}")
        else:
            found += ["", text] if last == "definition" else [text]
            last = "text"
        last = "" if not line.strip() else "definition" if begins else last
    return found


def lead_back(app, page: str, template, context, doctree) -> None:
    """Lead a page of source back to the public names: viewcode asks for those of the modules that define them."""
    if page.startswith("_modules/"):
        for name, module in crc._MODULE_OF.items():
            context["body"] = re.sub(
                rf"(?<=#camera_ray_caster){re.escape(module)}(?=\.{name}\b)", "", context.get("body", "")
            )


def add_files(app, error) -> None:
    """Add to a finished site what is no page: where it starts, and the lesson."""
    if error is None and app.builder.name == "html":
        (Path(app.outdir) / "index.html").write_text(START, encoding="utf-8")
        lesson = ROOT / "docs" / "lesson"
        if lesson.is_dir():
            shutil.copytree(lesson, Path(app.outdir) / "docs" / "lesson", dirs_exist_ok=True)
