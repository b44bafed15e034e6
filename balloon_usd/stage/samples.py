"""The time samples: one value of each moving attribute at every whole time code, streamed to disk."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pxr import Sdf

from balloon_usd.stage.animated import ON_MESH, ON_ROOT, STEP
from balloon_usd.stage.error import StageError, writing
from balloon_usd.stage.frame_check import check_frame
from balloon_usd.stage.layer_metadata import set_time_range
from balloon_usd.stage.pose import Pose, pose_of, union
from balloon_usd.stage.prim_paths import mesh_path, root_path

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription, StageFrame

SAVE_BYTES = 8 * 2**20
"""Samples kept in memory before they are saved [B].

Saving costs about 6 kB of file each time, so small sculptures are saved once. A repack at the end
(`Export`) would win 0.1 % of the file, and map all of it into memory.
"""


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

    @property
    def frames(self) -> int:
        """Number of frames."""
        return self.last - self.first + 1


class SampleStream:
    """Samples on their way into a layer, which is saved as it grows; memory does not grow with the frames."""

    def __init__(self, layer: Any, description: StageDescription, target: Path) -> None:
        """Prepare the layer's moving attributes; `target` names the stage in error messages."""
        self.layer = layer
        self._description = description
        self._target = target
        self._tracks = _declare(layer, description)
        self._take: Take | None = None
        self._unsaved = 0

    def write(self, frame: StageFrame) -> None:
        """Write one frame.

        Raises:
            StageError: The frame is not right, or the layer cannot be saved.
        """
        check_frame(frame, self._description, self._take.last + 1 if self._take else None)
        pose = pose_of(frame, self._description)
        _write(self.layer, self._tracks, frame.time_code, pose)
        self._take = _longer(self._take, frame.time_code, pose)
        self._unsaved += pose.size
        if self._unsaved >= SAVE_BYTES:
            with writing(self._target):
                self.layer.Save()
            self._unsaved = 0

    def close(self) -> Take:
        """Write the steps and the time range; the layer is left to be saved once more.

        Raises:
            StageError: There was no frame.
        """
        take = self._take
        if take is None:
            raise StageError(f'"{self._description.name}": there are no frames')
        _write_steps(self.layer, self._description, take)
        set_time_range(self.layer, self._description.fps, take.first, take.last)
        return take


def _declare(layer: Any, description: StageDescription) -> list[tuple[Any, ...]]:
    """Create the moving attributes: the paths of the meshes' in order, then those of the root's."""
    paths = []
    for mesh in description.meshes:
        prim = Sdf.CreatePrimInLayer(layer, mesh_path(description.name, mesh.name))
        paths.append(tuple(Sdf.AttributeSpec(prim, a.name, a.type_name).path for a in ON_MESH))
    root = layer.GetPrimAtPath(root_path(description.name))
    custom = {"variability": Sdf.VariabilityVarying, "declaresCustom": True}
    paths.append(tuple(Sdf.AttributeSpec(root, a.name, a.type_name, **custom).path for a in ON_ROOT))
    return paths


def _write(layer: Any, tracks: list[tuple[Any, ...]], time_code: int, pose: Pose) -> None:
    """Set one sample of every attribute."""
    for paths, mesh in zip(tracks[:-1], pose.meshes, strict=True):
        for path, on_mesh in zip(paths, ON_MESH, strict=True):
            layer.SetTimeSample(path, time_code, on_mesh.read(mesh))
    for path, on_root in zip(tracks[-1], ON_ROOT, strict=True):
        layer.SetTimeSample(path, time_code, on_root.read(pose))


def _longer(take: Take | None, time_code: int, pose: Pose) -> Take:
    """The take with one more frame."""
    if take is None:
        return Take(time_code, time_code, pose, pose.extent)
    return Take(take.first, time_code, pose, union([take.extent, pose.extent]))


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
