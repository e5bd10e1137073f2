"""The work that a cast did not need to do, in words."""

from ..casting.passes import PASSES
from ..casting.plan import Plan
from ..shapes import kinds

MOST_NAMED = 8
"""Number of shapes that a line names."""


def omitted(plan: Plan) -> list[str]:
    """Return a line for each kind of work that a plan leaves out."""
    lines, camera, shapes = [], plan.camera, plan.shapes
    if plan.unseen:
        lines.append(f"{plan.unseen} of {len(shapes)} shapes: no pixel can see them")
    if len(plan.beyond):
        names = [*dict.fromkeys(shapes.names[shapes.name_index[row]] for row in plan.beyond)]
        unnamed = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        ends = f"{camera.clip_start:g} to {camera.clip_end:g}"
        lines.append(f"{', '.join(map(repr, names[:MOST_NAMED]))}{unnamed}: beyond the clip range, {ends}")
    there = {kind.number for kind, _ in kinds.by_kind(shapes.kind[plan.seen])}
    missing = [kind.name for kind in kinds.SHAPE_KINDS if kind.number not in there]
    if missing:
        lines.append(f"kernels of {', '.join(missing)}: no such shape is in view")
    if camera.model.central:
        lines.append("origins of rays: all rays start at the eye")
    if not plan.clips:
        lines.append("the clip end: no shape in view extends beyond it")
    if spare := [name for name in PASSES if name not in plan.request.passes]:
        lines.append(f"passes {', '.join(spare)}: not requested")
    return lines
