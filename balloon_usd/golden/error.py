"""What can go wrong with golden stages."""

from __future__ import annotations


class GoldenError(Exception):
    """The list of golden stages is wrong; one line for each problem, with file, line and column."""
