"""The form in which `run` writes stages: choices that go together."""

from __future__ import annotations

from balloon_usd.batch.looks import LOOKS, WITH_AIR
from balloon_usd.cli.failure import ExitCode, Failure


def require_form(*, flat: bool, usdz: bool, look: str | None, shot: bool) -> None:
    """Check that the choices go together.

    Raises:
        Failure: they exclude each other, or there is no such look, with the nearest.
    """
    if flat and usdz:
        raise Failure("--flat and --usdz: choose one of them, or neither for a folder", ExitCode.BAD_INPUT)
    if usdz and shot:
        raise Failure(
            "--usdz and --shot: choose one of them, a shot refers to a folder or to --flat",
            ExitCode.BAD_INPUT,
        )
    if look is None or look in LOOKS:
        return
    if look != WITH_AIR:
        from balloon_usd.language.choices import unknown  # noqa: PLC0415

        raise Failure(f"--look: {unknown('look', look, (*LOOKS, WITH_AIR))}", ExitCode.BAD_INPUT)
    if usdz:
        raise Failure(f"--look {WITH_AIR}: a usdz holds no textures, take recipe", ExitCode.BAD_INPUT)
