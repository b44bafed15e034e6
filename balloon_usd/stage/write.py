"""Write a sculpture: stream the frames into hidden files, then give the whole its final name."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from balloon_usd.files.hashes import sha256_of
from balloon_usd.openusd import Sdf, Usd, usd_access
from balloon_usd.stage.asset import begin_asset, complete_asset
from balloon_usd.stage.description import require_identifier
from balloon_usd.stage.detail_files import MATERIALS
from balloon_usd.stage.error import StageError, writing
from balloon_usd.stage.flat import begin_flat, complete_flat, files_beside
from balloon_usd.stage.looks import default_look, require_look
from balloon_usd.stage.on_disk import why_not_named
from balloon_usd.stage.properties import one_sample_per_time_code, opens_whole
from balloon_usd.stage.samples import SampleStream
from balloon_usd.stage.shot import shot_name, write_shot
from balloon_usd.stage.usdz import begin_usdz, complete_usdz
from balloon_usd.stage.variant_sets import FINISHED
from balloon_usd.stage.wanted import Wanted
from balloon_usd.stage.workspace import Workspace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from os import PathLike
    from types import TracebackType

    from balloon_usd.stage.built import Built
    from balloon_usd.stage.description import StageDescription, StageFrame
    from balloon_usd.stage.properties import Finding
    from balloon_usd.stage.samples import Layers, Take

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
    sha256: Mapping[Path, str] = field(default_factory=dict, compare=False)
    """Hashes of the files, as they were when they got their names."""
    size: int = field(default=0, compare=False)
    """Of all files together [B]."""


class _Form(NamedTuple):
    """A form that a stage can have on disk."""

    ending: str
    """Of the file; "" for a folder with layers."""
    begin: Callable[[StageDescription, Wanted, Workspace], Layers]
    complete: Callable[[Layers, Take, StageDescription, Wanted, Workspace], Built]


LAYERED = _Form("", begin_asset, complete_asset)
FLAT = _Form(".usdc", begin_flat, complete_flat)
USDZ = _Form(".usdz", begin_usdz, complete_usdz)


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
        usdz: bool = False,
        look: str | None = None,
        shot: bool = False,
    ) -> None:
        """Choose the place; see `write_stage`."""
        require_identifier(detail)
        if detail == MATERIALS.stem or detail.endswith(f"_{FINISHED}"):
            raise StageError(f'a detail cannot be called "{detail}"')
        self._form = _form(flat=flat, usdz=usdz, shot=shot)
        self._description = description
        shown = default_look(description, textured=not usdz) if look is None else look
        require_look(shown, description, textured=not usdz)
        self._wanted = Wanted(detail, shown, shot)
        self._final = Path(folder) / f"{description.name}{self._form.ending}"
        if why := why_not_named(self._final):
            raise StageError(f"could not be written: {why}")
        with writing(self._final):
            self._find_the_way_free()
        self._work = Workspace(self._final)

    def _find_the_way_free(self) -> None:
        if self._final.exists() and self._final.is_dir() == bool(self._form.ending):
            in_the_way = "folder" if self._form.ending else "file"
            raise StageError(f"{self._final} could not be written: a {in_the_way} is in the way")
        for beside in (self._final.with_name(name) for name in self._beside()):
            if beside.is_dir():
                raise StageError(f"{beside} could not be written: a folder is in the way")

    @usd_access()
    def __enter__(self) -> Self:
        """Make the hidden files; raises `StageError` when the folder cannot be written."""
        with ExitStack() as stack:
            stack.enter_context(self._work)
            self._layers = self._form.begin(self._description, self._wanted, self._work)
            self._stream = SampleStream(self._layers, self._description, self._final)
            self._stack = stack.pop_all()
        return self

    @usd_access()
    def write(self, frame: StageFrame) -> None:
        """Take one frame; raises `StageError` when it is not right or the disk is full."""
        self._stream.write(frame)

    @usd_access()
    def finish(self, failed: str = "", facts: Mapping[str, int] | None = None) -> WrittenStage:
        """Write the rest and give the stage its final name.

        Args:
            failed: why the simulation ended before its last frame, if it did. The stage says so then and is
                called NAME.failed; what stands under the final name stays.
            facts: what is known of the frames, for the root layer's customLayerData.

        Raises:
            StageError: it cannot be written, or there are no frames.
        """
        take = self._stream.close()
        self._wanted = replace(self._wanted, failed=failed, facts=facts or {})
        built = self._form.complete(self._layers, take, self._description, self._wanted, self._work)
        del self._stream, self._layers
        if failed:
            self._final = self._final.with_name(f"{self._stem}{self._form.ending}")
            self._work.rename(self._final)
        _verify(self._work.built / built.files[0], one_sample_per_time_code)
        if self._wanted.shot:
            _verify(write_shot(self._description, take, self._work, built.files[0], shot_name(self._stem)))
        # Where they are built nobody else changes them.
        made = {self._final / file: self._work.built / file for file in built.files}
        made |= {self._final.with_name(name): self._work.built.with_name(name) for name in self._beside()}
        with writing(self._final):
            sha256 = {file: sha256_of(hidden) for file, hidden in made.items()}
            size = sum(hidden.stat().st_size for hidden in made.values())
        self._work.publish(self._beside())
        files = tuple(made)
        _refresh(files)
        low, high = ((float(x), float(y), float(z)) for x, y, z in take.extent)
        return WrittenStage(files, take.frames, (low, high), built.stale, sha256, size)

    @usd_access()
    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove what was not finished."""
        for left in ("_stream", "_layers"):
            self.__dict__.pop(left, None)
        self._stack.close()

    @property
    def _stem(self) -> str:
        return self._wanted.file_stem(self._description.name)

    def _beside(self) -> tuple[str, ...]:
        """Names of the files that stand beside the stage."""
        textures = files_beside(self._description) if self._form == FLAT else ()
        return (*textures, shot_name(self._stem)) if self._wanted.shot else textures


def write_stage(
    description: StageDescription,
    frames: Iterable[StageFrame],
    folder: str | PathLike[str],
    *,
    detail: str = "draft",
    flat: bool = False,
    usdz: bool = False,
    look: str | None = None,
    shot: bool = False,
) -> WrittenStage:
    """Write frames as they come to `folder/NAME/NAME.usda` and its payload, or to one file.

    Memory does not grow with the number of frames. Until the last file is whole nothing stands under the
    final name, and what stood there before stays. Other details of the same recipe stay as variants.

    Args:
        description: what the stage shows.
        frames: at consecutive time codes.
        folder: gets the stage; made if need be.
        detail: name of the variant that the frames are.
        flat: write the one file `NAME.usdc` with one look. Where there is air, it takes along the texture of
            the wire, `wire.png`, which is the same for every sculpture.
        usdz: write the one file `NAME.usdz` with one look, Y up and without textures, for AR viewers.
        look: that is selected; None takes the recipe's colours, or with air and textures the thesis's look.
        shot: write `NAME_shot.usda` beside it too, with camera, lights and ground.

    Raises:
        StageError: The folder cannot be written, the disk is full, a frame is not right, there is no such
            look, or the choices exclude each other.
    """
    with StageWriter(
        description, folder, detail=detail, flat=flat, usdz=usdz, look=look, shot=shot
    ) as writer:
        for frame in frames:
            writer.write(frame)
        return writer.finish()


def _form(*, flat: bool, usdz: bool, shot: bool) -> _Form:
    """The form that is asked for."""
    if flat and usdz:
        raise StageError("flat and usdz exclude each other: a stage has one form at a time")
    if usdz and shot:
        raise StageError("usdz and shot exclude each other: a shot refers to a stage whose z is up")
    return USDZ if usdz else FLAT if flat else LAYERED


def _verify(file: Path, *also: Callable[[Any], Iterator[Finding]]) -> None:
    """Open what was built: a write that failed unnoticed must not get the final name."""
    with writing(file):
        stage = Usd.Stage.Open(str(file))
    for finding in (found for check in (opens_whole, *also) for found in check(stage)):
        raise StageError(f"{file.name} was not written whole: {finding}")


def _refresh(files: Iterable[Path]) -> None:
    """Let stages that this process holds open see the new files."""
    for file in files:
        layer: Any = Sdf.Layer.Find(str(file.absolute()))
        if layer:
            with writing(file):
                layer.Reload()
