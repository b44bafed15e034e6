"""The golden room: recipes held to the stages that they gave when somebody last looked."""

from __future__ import annotations

from balloon_usd.golden.entry import GoldenEntry
from balloon_usd.golden.error import GoldenError
from balloon_usd.golden.keeping import DEVICE, Compare, Update, perform, update, verify
from balloon_usd.golden.list_file import FILE_NAME, read_list
from balloon_usd.golden.new_entry import enter

__all__ = [
    "DEVICE",
    "FILE_NAME",
    "Compare",
    "GoldenEntry",
    "GoldenError",
    "Update",
    "enter",
    "perform",
    "read_list",
    "update",
    "verify",
]
