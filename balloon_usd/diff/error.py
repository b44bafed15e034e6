"""What can go wrong while stages are compared."""

from __future__ import annotations


class DiffError(Exception):
    """Two stages cannot be compared; the message is one line that says why."""


class DamagedStageError(DiffError):
    """A value of a stage cannot be read."""


class DiffNotWrittenError(DiffError):
    """Stages were compared, but the picture or page of it could not be put where it belongs."""
