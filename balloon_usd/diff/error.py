"""What can go wrong while stages are compared."""

from __future__ import annotations


class DiffError(Exception):
    """Two stages cannot be compared; the message is one line that says why."""


class DiffNotWrittenError(DiffError):
    """Stages were compared, but the picture or page of it could not be put where it belongs."""
