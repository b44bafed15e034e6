"""What can go wrong with a batch as a whole."""

from __future__ import annotations


class BatchError(Exception):
    """A batch cannot go on; the message says why."""


class NotKept(BatchError):  # noqa: N818
    """The journal cannot be written, as on a full disk; the message says where and why."""
