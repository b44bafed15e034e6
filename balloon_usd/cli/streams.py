"""Standard streams as every command may take them for granted, however it was started."""

from __future__ import annotations

import io
import os
import sys
from typing import TextIO

STANDARD = (0, 1, 2)
"""Descriptors of input, output and errors."""


def complete_streams() -> None:
    """Let every standard stream that is closed lead nowhere, and the output write no halves.

    What is opened next would else get the number of a closed one, as the connection of a worker did. And
    Python, told not to buffer (PYTHONUNBUFFERED), loses what a full disk does not take, without a word.
    """
    for number in STANDARD:
        try:
            os.fstat(number)
        except OSError:
            # It gets the lowest number that is free, and workers get it, too.
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)
    if sys.stdin is None:
        sys.stdin = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stdout, sys.stderr = sys.stdout or _nowhere(1), sys.stderr or _nowhere(2)
    stream = sys.__stdout__
    if (
        isinstance(stream, io.TextIOWrapper)
        and stream is sys.stdout
        and isinstance(stream.buffer, io.RawIOBase)
    ):
        whole = io.BufferedWriter(stream.buffer)
        sys.stdout = io.TextIOWrapper(whole, stream.encoding, stream.errors, line_buffering=True)


def _nowhere(number: int) -> TextIO:
    return open(number, "w", encoding="utf-8", errors="backslashreplace", closefd=False)
