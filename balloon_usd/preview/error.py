"""What can go wrong while a stage is drawn."""

from __future__ import annotations


class PreviewError(Exception):
    """A stage cannot be drawn; the message is one line that says why."""


class PictureNotWrittenError(PreviewError):
    """A picture was drawn, but could not be put where it belongs."""
