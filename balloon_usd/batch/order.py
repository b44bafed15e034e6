"""What is asked of every recipe of a batch."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.balloon.detail import detail_named
from balloon_usd.batch.looks import LOOKS, WITH_AIR
from balloon_usd.language.choices import unknown

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class FrameRange:
    """Time codes from `first` to `last`, both included; None leaves an end open."""

    first: int | None = None
    last: int | None = None

    def within(self, count: int) -> range:
        """Return the time codes of the range in an animation of `count` frames.

        Raises:
            ValueError: none of them is in the animation.
        """
        codes = range(self.first or 1, min(self.last or count, count) + 1)
        if not codes:
            raise ValueError(f"--frames {self}: the animation has frames 1 to {count}")
        return codes

    def __str__(self) -> str:
        """Format as on the command line."""
        return f"{self.first or ''}:{self.last or ''}"


@dataclass(frozen=True)
class Order:
    """How the stages of a batch are wanted, and what stands beside them."""

    folder: Path
    """Output folder; a text is taken, too."""
    detail: str = "draft"
    flat: bool = False
    usdz: bool = False
    look: str | None = None
    shot: bool = False
    frames: FrameRange = FrameRange()
    preview: bool = True
    """Whether a contact sheet is drawn."""
    report: bool = True
    force: bool = False
    """Whether to make anew what is there already."""

    def __post_init__(self) -> None:
        """Take the folder as a path; raises `ValueError` or `TypeError` for what cannot be ordered."""
        object.__setattr__(self, "folder", Path(self.folder))
        detail_named(self.detail)
        if not isinstance(self.frames, FrameRange):
            raise TypeError(f"frames are {self.frames!r}, expected a FrameRange, such as FrameRange(1, 24)")
        if self.look is not None and self.look not in (*LOOKS, WITH_AIR):
            raise ValueError(unknown("look", self.look, (*LOOKS, WITH_AIR)))
        if self.usdz and (self.flat or self.shot):
            other = "flat" if self.flat else "shot"
            raise ValueError(f"{other} and usdz exclude each other")

    @property
    def ending(self) -> str:
        """Of a stage in one file; "" for a folder of layers."""
        return ".usdz" if self.usdz else ".usdc" if self.flat else ""

    @property
    def form(self) -> Mapping[str, Any]:
        """Keyword arguments of `balloon_usd.stage.StageWriter`."""
        return {
            "detail": self.detail,
            "flat": self.flat,
            "usdz": self.usdz,
            "look": self.look,
            "shot": self.shot,
        }

    def stage(self, name: str) -> Path:
        """Return the file of a sculpture's stage that people open."""
        return self.folder / f"{name}{self.ending}" if self.ending else self.folder / name / f"{name}.usda"

    def sheet(self, name: str) -> Path:
        """Return the file of a sculpture's contact sheet."""
        return self.folder / f"{name}.png"

    def shot_file(self, name: str) -> Path:
        """Return the file of a sculpture's shot."""
        return self.folder / f"{name}_shot.usda"

    def report_files(self, name: str) -> tuple[Path, Path]:
        """Return the files of a sculpture's report: its numbers and its figure."""
        return self.folder / f"{name}.report.json", self.folder / f"{name}.report.png"

    def in_the_way(self, name: str) -> list[str]:
        """Return what stands where the files of a sculpture must go, a line each."""
        files = [
            *([self.sheet(name)] if self.preview else []),
            *(self.report_files(name) if self.report else ()),
            *([self.shot_file(name)] if self.shot else []),
            *([self.stage(name)] if self.ending else []),
        ]
        asset = self.stage(name).parent
        try:
            found = [f"{file}: a folder is in the way" for file in files if file.is_dir()]
            if not self.ending and asset.exists() and not asset.is_dir():
                found.append(f"{asset}: a file is in the way")
        except OSError as error:
            return [f"{asset}: cannot write here ({error.strerror or error})"]
        return found
