"""Write a sculpture: stream the frames into hidden files, then give the whole its final name."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from pxr import Sdf, Usd

from balloon_usd.stage.asset import begin_asset, complete_asset
from balloon_usd.stage.description import require_identifier
from balloon_usd.stage.earlier import MATERIALS
from balloon_usd.stage.error import StageError, writing
from balloon_usd.stage.flat import begin_flat, complete_flat, files_beside
from balloon_usd.stage.properties import one_sample_per_time_code, opens_whole
from balloon_usd.stage.samples import SampleStream
from balloon_usd.stage.workspace import Workspace

if TYPE_CHECKING:
    from collections.abc import Iterable
    from os import PathLike
    from types import TracebackType

    from balloon_usd.stage.description import StageDescription, StageFrame

Corner = tuple[float, float, float]


@dataclass(frozen=True)
class WrittenStage:
    """What a run left on disk."""

    files: tuple[Path, ...]
    """Files of this run; the first one is the one to open."""
    frames: int
    """Number of frames."""
    extent: tuple[Corner, Corner]
    """Smallest and largest corner over all time codes [m]."""
    stale: tuple[str, ...] = ()
    """Details that an earlier run had left, removed since they show another recipe."""


class StageWriter:
    """A stage that takes its frames one by one, for several stages that grow side by side.

    Use it in a `with` block, and call `finish` in it: a block that is left without leaves nothing.
    """

    def __init__(
        self,
        description: StageDescription,
        folder: str | PathLike[str],
        *,
        detail: str = "draft",
        flat: bool = False,
    ) -> None:
        """Choose the place; see `write_stage`."""
        require_identifier(detail)
        if detail == MATERIALS.stem:
            raise StageError(f'a detail cannot be called "{detail}"')
        self._description, self._detail, self._flat = description, detail, flat
        self._final = Path(folder) / (f"{description.name}.usdc" if flat else description.name)
        if self._final.exists() and self._final.is_dir() == flat:
            in_the_way = "folder" if flat else "file"
            raise StageError(f"{self._final} could not be written: a {in_the_way} is in the way")
        for beside in (self._final.with_name(name) for name in (files_beside(description) if flat else ())):
            if beside.is_dir():
                raise StageError(f"{beside} could not be written: a folder is in the way")
        self._work = Workspace(self._final)

    def __enter__(self) -> Self:
        """Make the hidden files; raises `StageError` when the folder cannot be written."""
        with ExitStack() as stack:
            stack.enter_context(self._work)
            begin = begin_flat if self._flat else begin_asset
            layer = begin(self._description, self._detail, self._work)
            self._stream = SampleStream(layer, self._description, self._final)
            self._stack = stack.pop_all()
        return self

    def write(self, frame: StageFrame) -> None:
        """Take one frame; raises `StageError` when it is not right or the disk is full."""
        self._stream.write(frame)

    def finish(self) -> WrittenStage:
        """Write the rest and give the stage its final name; raises `StageError` when that fails."""
        take = self._stream.close()
        complete = complete_flat if self._flat else complete_asset
        built = complete(self._stream.layer, take, self._description, self._detail, self._work)
        del self._stream
        _verify(self._work.built / built.files[0])
        self._work.publish(built.beside)
        beside = tuple(self._final.with_name(name) for name in built.beside)
        files = (*(self._final / file for file in built.files), *beside)
        _refresh(files)
        low, high = ((float(x), float(y), float(z)) for x, y, z in take.extent)
        return WrittenStage(files, take.frames, (low, high), built.stale)

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove what was not finished."""
        self._stack.close()


def write_stage(
    description: StageDescription,
    frames: Iterable[StageFrame],
    folder: str | PathLike[str],
    *,
    detail: str = "draft",
    flat: bool = False,
) -> WrittenStage:
    """Write frames as they come to `folder/NAME/NAME.usda` and its payload, or to one `folder/NAME.usdc`.

    Memory does not grow with the number of frames. Until the last file is whole nothing stands under the
    final name, and what stood there before stays. Other details of the same recipe stay as variants.
    Where there is air, the one file takes along the texture of the wire, `folder/wire.png`, which is the
    same for every sculpture.

    Raises:
        StageError: The folder cannot be written, the disk is full, or a frame is not right.
    """
    with StageWriter(description, folder, detail=detail, flat=flat) as writer:
        for frame in frames:
            writer.write(frame)
        return writer.finish()


def _verify(file: Path) -> None:
    """Open what was built: a write that failed unnoticed must not get the final name."""
    with writing(file):
        stage = Usd.Stage.Open(str(file))
    for finding in (*opens_whole(stage), *one_sample_per_time_code(stage)):
        raise StageError(f"{file.name} was not written whole: {finding}")


def _refresh(files: Iterable[Path]) -> None:
    """Let stages that this process holds open see the new files."""
    for file in files:
        layer: Any = Sdf.Layer.Find(str(file.absolute()))
        if layer:
            with writing(file):
                layer.Reload()
