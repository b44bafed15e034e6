"""Frames on the command line: a range A:B, or a list of time codes."""

from __future__ import annotations

import re

import click

from balloon_usd.batch.order import FrameRange

MOST_FRAMES = 999_999_999
"""Frames that can be asked for."""


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
