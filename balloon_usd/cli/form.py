"""The form in which `run` writes stages: layers or one file, with which look, with or without a shot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from balloon_usd.plan import Plan

LOOKS = ("recipe", "clear", "chrome", "clay", "stress")
"""Looks of every stage."""
WITH_AIR = "thesis"
"""Look of stages of the model kosaka only; it needs a texture."""


@dataclass(frozen=True)
class Form:
    """How stages are written.

    Raises:
        Failure: the choices exclude each other.
    """

    flat: bool = False
    usdz: bool = False
    look: str | None = None
    shot: bool = False

    def __post_init__(self) -> None:
        if self.flat and self.usdz:
            raise Failure(
                "--flat and --usdz: choose one of them, or neither for a folder", ExitCode.BAD_INPUT
            )
        if self.usdz and self.shot:
            raise Failure(
                "--usdz and --shot: choose one of them, a shot refers to a folder or to --flat",
                ExitCode.BAD_INPUT,
            )

    @property
    def ending(self) -> str:
        """Of the one file; "" for a folder."""
        return ".usdz" if self.usdz else ".usdc" if self.flat else ""

    def stage(self, folder: Path, name: str) -> Path:
        """Return the file of a sculpture's stage that people open."""
        return folder / f"{name}{self.ending}" if self.ending else folder / name / f"{name}.usda"

    def require_look(self, plans: Iterable[Plan]) -> None:
        """Check that the stage of every plan can have the look.

        Raises:
            Failure: one cannot, with the nearest look.
        """
        if self.look is None or self.look in LOOKS:
            return
        if self.look != WITH_AIR:
            from balloon_usd.recipe.choices import unknown  # noqa: PLC0415

            raise Failure(f"--look: {unknown('look', self.look, (*LOOKS, WITH_AIR))}", ExitCode.BAD_INPUT)
        if self.usdz:
            raise Failure(f"--look {WITH_AIR}: a usdz holds no textures, take recipe", ExitCode.BAD_INPUT)
        airless = [plan.recipe.file for plan in plans if plan.recipe.physics.model != "kosaka"]
        if airless:
            needs = f"--look {WITH_AIR} needs model: kosaka, take one of {', '.join(LOOKS)}"
            raise Failure("\n".join(f"{file}: {needs}" for file in airless), ExitCode.BAD_INPUT)
