"""The time samples: one value of each moving attribute at every whole time code, streamed to disk."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf
from balloon_usd.stage.animated import STEP
from balloon_usd.stage.error import StageError, writing
from balloon_usd.stage.frame_check import check_frame
from balloon_usd.stage.held import HeldSamples
from balloon_usd.stage.layer_metadata import set_time_range
from balloon_usd.stage.pose import Pose, pose_of, union
from balloon_usd.stage.prim_paths import part_path, root_path
from balloon_usd.stage.stress import StressColors
from balloon_usd.stage.tracks import Tracks

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription, StageFrame

SAVE_BYTES = 4 * 2**20
"""Samples kept in memory before they are saved [B].

Saving costs about 6 kB of file each time, so small sculptures are saved once. A repack at the end
(`Export`) would win 0.1 % of the file, and map all of it into memory.
"""


BELOW = 2.0e-3
"""Depth below z = 0 from which on a figure is not on the ground yet [m]."""


@dataclass(frozen=True)
class Layers:
    """Where the samples go."""

    samples: Any
    """Layer of all that moves."""
    stress: Any = None
    """Layer of stretch as a colour: one of its own, the same, or none."""

    @property
    def apart(self) -> bool:
        """Whether the colours have a layer of their own."""
        return self.stress is not None and self.stress != self.samples

    @property
    def all(self) -> tuple[Any, ...]:
        """Each layer once."""
        return (self.samples, self.stress) if self.apart else (self.samples,)

    def save(self) -> None:
        """Bring to disk what was added."""
        for layer in self.all:
            layer.Save()


@dataclass(frozen=True)
class Take:
    """What was streamed."""

    first: int
    """First time code."""
    last: int
    """Last time code."""
    final: Pose
    """Pose at the last time code."""
    extent: NDArray[np.float32]
    """Smallest and largest corner over all time codes (2, 3) [m]."""
    below: int = 0
    """Last time code at which anything is below z = 0 by more than `BELOW`; 0 if nothing ever is."""

    @property
    def frames(self) -> int:
        """Number of frames."""
        return self.last - self.first + 1


class SampleStream:
    """Samples on their way into layers that are saved as they grow; memory does not grow with the frames."""

    def __init__(self, layers: Layers, description: StageDescription, target: Path) -> None:
        """Prepare the layers' moving attributes; `target` names the stage in error messages."""
        self._layers = layers
        self._description = description
        self._target = target
        layer = layers.samples
        self._tracks = Tracks.declare(layer, description)
        self._held = [HeldSamples(layer, part_path(description.name, air.name)) for air in description.airs]
        self._stress = (
            StressColors(layers.stress, description, indexed=layers.apart) if layers.stress else None
        )
        self._take: Take | None = None
        self._unsaved = 0

    def write(self, frame: StageFrame) -> None:
        """Write one frame.

        Raises:
            StageError: The frame is not right, or the layer cannot be saved.
        """
        check_frame(frame, self._description, self._take.last + 1 if self._take else None)
        pose = pose_of(frame, self._description)
        self._tracks.sample(self._layers.samples, frame.time_code, pose)
        for held, air in zip(self._held, pose.airs, strict=True):
            held.write(frame.time_code, air.cluster)
        self._unsaved += pose.size
        if self._stress:
            self._stress.write(frame.time_code, pose)
            self._unsaved += self._stress.bytes_a_frame
        self._take = _longer(self._take, frame.time_code, pose)
        if self._unsaved >= SAVE_BYTES:
            with writing(self._target):
                self._layers.save()
            self._unsaved = 0

    def close(self) -> Take:
        """Write the steps, the time range and the final colours; the layers are left to be saved once more.

        Raises:
            StageError: There was no frame.
        """
        take = self._take
        if take is None:
            raise StageError(f'"{self._description.name}": there are no frames')
        _write_steps(self._layers.samples, self._description, take)
        if self._stress:
            self._stress.close(take.final, still=self._layers.apart)
        for layer in self._layers.all:
            set_time_range(layer, self._description.fps, take.first, take.last)
        return take


def _longer(take: Take | None, time_code: int, pose: Pose) -> Take:
    """The take with one more frame."""
    below = time_code if float(pose.extent[0, 2]) < -BELOW else 0
    if take is None:
        return Take(time_code, time_code, pose, pose.extent, below)
    extent = union(take.extent, pose.extent)
    return Take(take.first, time_code, pose, extent, below or take.below)


def _write_steps(layer: Any, description: StageDescription, take: Take) -> None:
    """Sample what the hands do where it changes: a string is held until its next sample."""
    marks = steps_between(description.twists, take.first, take.last)
    if not marks:
        return
    root = layer.GetPrimAtPath(root_path(description.name))
    step = Sdf.AttributeSpec(root, STEP, Sdf.ValueTypeNames.String, declaresCustom=True)
    step.documentation = "What the hands do from this time code on."
    for time_code, text in marks.items():
        layer.SetTimeSample(step.path, time_code, text)


def steps_between(marks: Iterable[tuple[int, str]], first: int, last: int) -> dict[int, str]:
    """What the hands do, by the time code from which on they do it, over a range of time codes.

    A step begun before the range is moved to its start; nothing is done before the first step.
    Steps that begin together are joined.
    """
    by_code: dict[int, list[str]] = {}
    for time_code, text in sorted(marks, key=lambda mark: mark[0]):
        by_code.setdefault(time_code, []).append(text)
    begun = [code for code in by_code if code <= first]
    inside = {code: "; ".join(texts) for code, texts in by_code.items() if first < code <= last}
    if not begun and not inside:
        return {}
    return {first: "; ".join(by_code[begun[-1]]) if begun else ""} | inside
