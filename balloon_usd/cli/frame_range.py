"""Frames on the command line: a range A:B, or a list of time codes."""

from __future__ import annotations

import re
from dataclasses import dataclass

import click

MOST_FRAMES = 999_999_999
"""Frames that can be asked for."""


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


def frame_range(text: str) -> FrameRange:
    """Read A:B, A: or :B.

    Raises:
        click.BadParameter: it is none of these.
    """
    match = re.fullmatch(r"([1-9]\d{0,8})?:([1-9]\d{0,8})?", text, re.ASCII)
    if not match or text == ":":
        raise click.BadParameter(f'"{text}" is no range of frames, expected A:B, A: or :B, counted from 1')
    first, last = (int(end) if end else None for end in match.groups())
    if first and last and first > last:
        raise click.BadParameter(f'"{text}" begins after its end')
    return FrameRange(first, last)


def moments(text: str) -> FrameRange | tuple[int, ...]:
    """Read a list of time codes such as 1,40,80, or a range.

    Raises:
        click.BadParameter: it is neither.
    """
    if ":" in text:
        return frame_range(text)
    codes = text.split(",")
    if not all(re.fullmatch(r"\d{1,9}", code, re.ASCII) for code in codes):
        raise click.BadParameter(f'"{text}" is no list of frames, expected A:B or A,B,C')
    return tuple(int(code) for code in codes)
