"""What the tests share. Nothing here imports Blender until a test asks for it: tests/core runs without."""

import os
import sys
import tempfile
from time import monotonic

import pytest

from . import tiers

# Read once, at the first import of numpy: the tests run on all cores already, where threads of small matrices only wait
# for each other. A fit of a lens takes 1.7 s of the processors in place of 9.6.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Read once, at the first import of bpy: the tests neither see nor touch the user's settings. With pytest-xdist every
# worker imports this file, and so has a folder of its own.
_PROFILE = tempfile.TemporaryDirectory(prefix="camera_ray_caster_")
os.environ["BLENDER_USER_RESOURCES"] = _PROFILE.name

# The import of bpy sets it in the process, but not in os.environ, which tests give to the processes that they start:
# these would print a line about it. A worker inherits it from a pytest that has imported bpy.
os.environ.pop("OCIO", None)


@pytest.fixture(scope="session")
def registered():
    """The bpy module with the extension registered as the plain package ``camera_ray_caster``."""
    import bpy

    import camera_ray_caster

    bpy.ops.wm.read_factory_settings(use_empty=True)
    camera_ray_caster.register()
    yield bpy
    camera_ray_caster.unregister()


@pytest.fixture
def blender(registered):
    """The bpy module on an empty file, with the extension registered."""
    import camera_ray_caster

    registered.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    camera_ray_caster.register()  # again, after a test that has taken it away
    return registered


@pytest.fixture
def unregister(blender):
    """A function that takes the extension away for the rest of the test."""
    import camera_ray_caster

    yield camera_ray_caster.unregister
    camera_ray_caster.register()


_BEGAN = pytest.StashKey[float]()
_MODELS = pytest.StashKey[tuple]()
_STATUS = pytest.StashKey[int]()
_WORKERS = pytest.StashKey[float]()
TIME = "processor_seconds"


def pytest_addoption(parser):
    """Add the options of a camera model of somebody's own, and of a share of the tests."""
    parser.addoption("--model", help="a file with a camera model: only the tests of that model are run")
    parser.addoption("--part", metavar="K/N", help="run every N-th of the tests, beginning with the K-th")


def pytest_configure(config):
    """Begin to count seconds; add the camera model that is asked for, before tests ask for all models."""
    config.stash[_BEGAN] = monotonic()
    tiers.is_full = "not full" not in config.option.markexpr
    config.stash[_MODELS] = tiers.added_models(config.getoption("--model"))


@pytest.hookimpl(tryfirst=True, wrapper=True)
def pytest_collection_modifyitems(config, items):
    """Mark what the default tier leaves out, before pytest leaves it out, and sort; then leave out all but a part."""
    if config.stash[_MODELS]:
        items[:] = tiers.of_models(items, config.stash[_MODELS])
    tiers.mark_the_rest(items)
    tiers.longest_first(items)
    yield
    if config.getoption("--part"):
        first, step = map(int, config.getoption("--part").split("/"))
        kept = items[first - 1 :: step]
        config.hook.pytest_deselected(items=[item for item in items if item not in kept])
        items[:] = kept


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    """Add the processor time of a worker that has ended."""
    seconds = getattr(node, "workeroutput", {}).get(TIME, 0.0)
    node.config.stash[_WORKERS] = node.config.stash.get(_WORKERS, 0.0) + seconds


def pytest_terminal_summary(terminalreporter, config):
    """Print the seconds of the whole default tier beside its budget, and warn if they are more."""
    if "not full" in config.option.markexpr and config.args_source is config.ArgsSource.TESTPATHS:
        seconds = monotonic() - config.stash[_BEGAN]
        workers = config.stash.get(_WORKERS, 0.0)
        used = tiers.processor_seconds(of_children=not workers) + workers  # workers are children, too
        line = f"default tier: {seconds:.0f} s; {used:.0f} s of the processors, of a budget of {2 * tiers.BUDGET}"
        terminalreporter.write_line(line)
        if used > 2 * tiers.BUDGET:
            terminalreporter.write_line(
                "WARNING: the default tier is over its budget: make its slowest tests cheaper, or mark them full "
                "(--durations=20 lists them)",
                yellow=True,
            )


def pytest_sessionfinish(session, exitstatus):
    """Keep the status for the end; a worker hands its processor time in."""
    session.config.stash[_STATUS] = int(exitstatus)
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput[TIME] = tiers.processor_seconds()


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config):
    """End the process at once where pip's bpy was used: after many renders bpy 4.5 may hang in its own clean-up."""
    bpy = sys.modules.get("bpy")
    if bpy is not None and not bpy.app.binary_path and _STATUS in config.stash:
        _PROFILE.cleanup()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(config.stash[_STATUS])
