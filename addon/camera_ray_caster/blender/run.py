"""The one walk that every door takes: scene → camera → rays → hits → passes → report."""

from collections.abc import Callable, Sequence
from time import perf_counter

from ..core.cameras import camera_from
from ..core.cast import Images, cast
from ..core.report import Report, report_cast
from .check import verify_evaluated
from .read import camera_record, shapes_record


def run(
    depsgraph,
    camera_object,
    passes: Sequence[str],
    progress: Callable[[float], bool] | None = None,
) -> tuple[Images, Report]:
    """Cast the passes of an evaluated scene with one camera, and hold the camera against its witnesses.

    Reads the depsgraph only, so that a render's thread may call it. ``progress`` is as in ``cast``. Raises InputError
    where the camera cannot be cast, Cancelled where the user stopped.
    """
    scene = depsgraph.scene_eval
    started = perf_counter()
    camera = camera_from(camera_record(scene, camera_object, depsgraph))
    shapes = shapes_record(depsgraph)
    read = perf_counter() - started
    images = cast(camera, shapes, passes, shading=scene.camera_ray_caster.shading, progress=progress)
    started = perf_counter()
    findings = verify_evaluated(camera, camera_object, depsgraph)
    seconds = {"read": read, **images.seconds, "verify": perf_counter() - started}
    several = sum(layer.use for layer in scene.view_layers) > 1
    layer = depsgraph.view_layer_eval.name
    return images, report_cast(camera, shapes, images, seconds, findings, scene.frame_current_final, layer, several)
