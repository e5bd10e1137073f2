"""Motion between the times at which a scene was evaluated, and the choice of these times.

Each interval has four evaluations: its ends and two probes at the golden section. Between them positions, rotation
vectors, stretches (polar decomposition) and the numbers of a lens are the cubics through the four. Each probe tests
this against the motion of the scene: it must lie on the parabola through the other three evaluations, within the
tolerance in pixels. If it does not, the interval is cut at its probes. The method is the embedded pair of adaptive
integration (E. Hairer et al., Solving Ordinary Differential Equations I, section II.4): smooth motion takes few
evaluations, and the estimate is on the safe side.

Colors, lights, maps, clipping and focus are interpolated in the same way, within APPEARANCE. Indices change in steps,
shapes appear or disappear, and places jump: such a moment is found to SHORTEST. An event shorter than the distance of
the evaluations can be missed; whole frames and those with keys are evaluated first.
"""

from bisect import bisect_right
from collections.abc import Callable, Generator, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from ..camera.camera import Camera
from ..maths.rotations import polar, sine_and_angle
from ..records import Shapes
from .appearance import difference, same_indices
from .interpolation import State, TimeInterval, matched
from .landmarks import apart, lit
from .matching import same_rows
from .means import same

PROBES = (0.381966, 0.618034)
"""Probes as fractions of an interval: the golden section, so that no motion of a simple period is missed by both."""

WIDEST_TURN = 1.0
"""Maximum rotation from one evaluation to the next, radians: the three in an interval stay below a half turn."""

SHORTEST = 2.0**-10
"""Accuracy, in frames, of the moment at which shapes appear or disappear, or a place, an index or a color changes at
once.
"""

APPEARANCE = 1 / 255
"""Largest error of colors and maps between evaluations: one step of an 8 bit image. See ``appearance.difference``."""

UNRESOLVED = "NOT RESOLVED"
"""Beginning of the report's lines on motion that is not within the tolerance."""


@dataclass(frozen=True)
class Motion:
    """A camera and shapes over a range of frames, and their accuracy."""

    intervals: tuple[TimeInterval, ...]
    """The intervals in order; each begins at the end of the previous interval."""
    states: dict[float, State]
    tolerance: float
    """The requested tolerance in pixels."""
    estimated: float
    """The estimated largest error in the resolved intervals, in pixels."""
    unresolved: tuple[tuple[float, float], ...]
    """Intervals in which the tolerance is not kept."""
    measured: float = np.nan
    """The largest error, in pixels, at frames that were evaluated only as a check; NaN without a check."""
    appearance: tuple[float, float] = (0.0, np.nan)
    """The estimated and the measured largest error of colors, lights, maps, clipping and focus: see ``_change``."""

    def camera_at(self, frame: float) -> Camera:
        """Return the camera at a frame, without its pixel_time."""
        return replace(self._interval(frame).camera_at(frame), pixel_time=None)

    @cached_property
    def is_still(self) -> bool:
        """Whether camera and shapes are the same in all evaluations."""
        looks = [(c.model, c.pose, c.aperture, c.clip_start, c.clip_end, shapes) for c, shapes in self.states.values()]
        return all(same(looks[0], other) for other in looks[1:])

    @cached_property
    def camera_is_still(self) -> bool:
        """Whether the camera has the same model and pose in all evaluations."""
        looks = [(camera.model, camera.pose) for camera, _ in self.states.values()]
        return all(same(looks[0], other) for other in looks[1:])

    def parts(self, frames: np.ndarray) -> Iterator[tuple[TimeInterval, np.ndarray]]:
        """Yield intervals and the indices of the frames within."""
        starts = [interval.frames[0] for interval in self.intervals]
        interval_of = np.maximum(np.searchsorted(starts, frames, side="right") - 1, 0)
        for k in np.unique(interval_of).tolist():
            yield self.intervals[k], np.flatnonzero(interval_of == k)

    def poses_at(self, frames: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the eyes (n, 3) and bases (n, 3, 3) of the camera at frames (n,); None if its model changes."""
        if not all(same(camera.model, other.model) for (camera, _), (other, _) in pairwise(self.states.values())):
            return None
        eyes, bases = np.empty((len(frames), 3)), np.empty((len(frames), 3, 3))
        for interval, within in self.parts(frames):
            eyes[within], bases[within] = interval.poses_at(frames[within])
        return eyes, bases

    def shapes_at(self, frame: float) -> Shapes:
        """Return the shapes at a frame."""
        return self._interval(frame).shapes_at(frame)

    def at(self, frame: float) -> State:
        """Return camera and shapes at a frame."""
        return self.camera_at(frame), self.shapes_at(frame)

    @property
    def cuts(self) -> tuple[float, ...]:
        """The frames at which intervals meet: motion may change abruptly there."""
        return tuple(interval.frames[0] for interval in self.intervals[1:])

    def _interval(self, frame: float) -> TimeInterval:
        k = bisect_right(self.intervals, frame, key=lambda interval: interval.frames[0]) - 1
        return self.intervals[max(k, 0)]

    def in_words(self) -> list[str]:
        """Return lines for the report on the accuracy of the motion."""
        first, last = self.intervals[0].frames[0], self.intervals[-1].frames[-1]
        lines = [
            f"frames {first:g} to {last:g} from {len(self.states)} evaluations: motion off by {self.estimated:.2g} "
            f"pixels as estimated, {self.measured:.2g} as measured; the tolerance is {self.tolerance:g}"
        ]
        estimated, measured = self.appearance
        if estimated > 0 or measured > 0:
            lines.append(
                f"colors, lights, maps, clipping and focus off by {estimated:.2g} as estimated, {measured:.2g} as "
                f"measured, of 1; the tolerance is {APPEARANCE:.2g}"
            )
        jumps = [interval.frames[0] for interval in self.intervals[:-1] if len(interval.frames) == 1]
        if jumps:
            lines.append(
                f"jumps: {len(jumps)}, the first at frame {jumps[0]:g}; between two frames {SHORTEST:.2g} apart, all "
                "places are those of the earlier frame"
            )
        each = [shapes for _, shapes in self.states.values()]
        if not all(same_rows(each[0], other) for other in each[1:]):
            lines.append("shapes appear or disappear: shape_index counts those that are there at a pixel's own time")
        if self.measured > self.tolerance:
            lines.append(
                f"{UNRESOLVED}: motion off by {self.measured:.2g} pixels where it was measured, between evaluations: "
                "lower the tolerance, or set a key where the motion changes"
            )
        if self.unresolved:
            low, high = self.unresolved[0]
            lines.append(
                f"{UNRESOLVED}: {len(self.unresolved)} intervals, the first at frames {low:g} to {high:g}: "
                "the scene changes too fast for the evaluations allowed"
            )
        return lines


def resolve(
    evaluate: Callable[[float], State],
    first: float,
    last: float,
    tolerance: float,
    limit: int,
    keys: Iterable[float] = (),
) -> Motion:
    """Evaluate a scene at as few frames as keep the motion between them within ``tolerance`` pixels.

    ``evaluate(frame)`` returns camera and shapes; it is called at most ``limit`` times. See ``resolving``.
    """
    steps, state = resolving(first, last, tolerance, limit, keys), None
    while True:
        try:
            state = evaluate(steps.send(state))
        except StopIteration as end:
            return end.value


def resolving(
    first: float, last: float, tolerance: float, limit: int, keys: Iterable[float]
) -> Generator[float, State | None, Motion]:
    """Yield the frames that ``resolve`` evaluates, receive their states, and return the motion.

    Whole frames, since cuts lie there, and ``keys``, the frames with keys, are evaluated first; if these are more than
    a quarter of ``limit``, those with keys only, or else whole frames only, or else evenly spaced ones of both. Then
    intervals are tested, the longest first. Those that remain when the budget is used up are reported as unresolved.
    """
    states: dict[float, State] = {}

    def know(*frames: float) -> Generator[float, State | None, None]:
        for frame in frames:
            if frame not in states:
                state = yield frame
                assert state is not None
                states[frame] = with_lens_of(next(iter(states.values()), state), state)

    if first == last:
        yield from know(first)
        return Motion((TimeInterval.of(states, (first,)),), states, tolerance, 0.0, ())
    whole = np.arange(np.floor(first) + 1, np.ceil(last)).tolist()
    keyed = sorted({float(frame) for frame in keys if first < frame < last})
    known_frames, few = sorted({*whole, *keyed}), max(1, limit // 4)
    evenly = known_frames[:: -(-len(known_frames) // few) or 1]
    at_once = next((frames for frames in (known_frames, keyed, whole) if len(frames) <= few), evenly)
    ends = [first, *at_once, last]
    yield from know(*ends)
    waiting = list(pairwise(ends))
    done: list[tuple[float, ...]] = []
    unresolved, estimated, seen = [], 0.0, 0.0
    while waiting:
        waiting.sort(key=lambda ends: ends[1] - ends[0])
        a, b = waiting.pop()
        p, q = (a + (b - a) * share for share in PROBES)
        is_moment = b - a <= SHORTEST
        is_step = not _continuous(states[a], states[b])
        if is_step and is_moment:
            done.append((a, b))
            continue
        if len(states) + (p not in states) + (q not in states) > limit or not a < p < q < b:
            unresolved.append((a, b))
            done.append((a, b))
            continue
        yield from know(p, q)
        probed = [
            (TimeInterval.of(states, others).at(probe), states[probe])
            for probe, others in ((p, (a, q, b)), (q, (a, p, b)))
        ]
        off, change = (max(error(*pair) for pair in probed) for error in (apart, _change))
        steps = [(states[early], states[late]) for early, late in pairwise((a, p, q, b))]
        turn = max(_turn(*step) for step in steps)
        moves = [apart(*step) for step in steps] if off > tolerance else []
        is_jump = sum(move > tolerance for move in moves) == 1
        if is_jump and is_moment:
            estimated = max(estimated, sum(sorted(moves)[:-1]))
            done += [(a,), (b,)] if b == last else [(a,)]  # held until the next interval begins
            continue
        if is_step or off > tolerance or turn > WIDEST_TURN or (change > APPEARANCE and not is_moment):
            cuts = [a, p, q, b]
            beside = b - SHORTEST
            if is_jump and moves[-1] > tolerance and b in keyed and beside > q and len(states) < limit:
                yield from know(beside)  # a key may begin with a jump
                cuts.insert(3, beside)
            waiting += pairwise(cuts)
            continue
        estimated = max(estimated, off)
        if change > APPEARANCE:
            done.append((a, b))
        else:
            seen = max(seen, change)
            done.append((a, p, q, b))
    intervals = tuple(TimeInterval.of(states, frames) for frames in sorted(done))
    return Motion(intervals, states, tolerance, estimated, tuple(sorted(unresolved)), appearance=(seen, np.nan))


def measured(motion: Motion, evaluate: Callable[[float], State], frames) -> Motion:
    """Return a motion with its errors measured at some frames: the interpolated against the evaluated scene."""
    first = next(iter(motion.states.values()))
    pairs = [(motion.at(frame), with_lens_of(first, evaluate(frame))) for frame in frames]
    off, change = (max((error(*pair) for pair in pairs), default=0.0) for error in (apart, _change))
    return replace(motion, measured=off, appearance=(motion.appearance[0], change))


def with_lens_of(known: State, state: State) -> State:
    """Return a state with the very lens of a known one if both are the same, so that its tables are computed once."""
    (other, _), (camera, shapes) = known, state
    return (replace(camera, model=other.model), shapes) if same(other.model, camera.model) else state


def _continuous(before: State, after: State) -> bool:
    """Whether two states have the same shapes with the same indices, and both an aperture or none."""
    (camera, shapes), (other, others) = before, after
    same = matched(shapes, others) and same_indices(shapes, others)
    return same and (camera.aperture is None) == (other.aperture is None)


def _change(state: State, truth: State) -> float:
    """Return the largest difference in the appearance of two states' shapes, and the largest relative difference in the
    clipping and the aperture of their cameras; infinite if the shapes differ, or only one camera has an aperture.
    """
    (camera, shapes), (true_camera, true_shapes) = state, truth
    lens, true_lens = _lens(camera), _lens(true_camera)
    if not matched(shapes, true_shapes) or len(lens) != len(true_lens):
        return np.inf
    with np.errstate(all="ignore"):
        off = np.where(lens == true_lens, 0.0, np.abs(lens - true_lens) / np.abs(true_lens))
    return max(float(off.max()), difference(shapes, true_shapes, lit(truth)))


def _lens(camera: Camera) -> np.ndarray:
    """Return the numbers of a camera that change what its rays show, but not the rays through pixel centers."""
    opening = camera.aperture
    numbers = () if opening is None else (opening.radius, opening.focus, opening.rotation, opening.ratio, *opening.tilt)
    return np.array((camera.clip_start, camera.clip_end, *numbers))


def _turn(before: State, after: State) -> float:
    """Return the largest rotation between two evaluations, radians; 0 for shapes that cannot be matched."""
    turns = [_angle(before[0].pose.basis[None], after[0].pose.basis[None])]
    if matched(before[1], after[1]):
        turns.append(_angle(before[1].axes, after[1].axes))
    return max(float(turn.max(initial=0.0)) for turn in turns)


def _angle(before, after) -> np.ndarray:
    return sine_and_angle(polar(after)[0] @ np.swapaxes(polar(before)[0], 1, 2))[2]
