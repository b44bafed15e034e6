"""What can go wrong while meshes come in from other formats or leave for them."""

from __future__ import annotations


class ExchangeError(Exception):
    """A mesh cannot be read or passed on as asked; the message is one line that says why."""


class NotExportedError(ExchangeError):
    """A file was made, but could not be put where it belongs."""
