"""The check room: whatever is wrong with a stage on disk, told in one list.

`check_file` tests all properties of `balloon_usd.stage.properties` in every variant, what only a folder or
a flattened stage shows, and asks the validators of usd-core and, where it is installed, of NVIDIA.
`count_crossings` counts walls that pierce walls in every frame.
"""

from __future__ import annotations

from balloon_usd.check.check import check_file
from balloon_usd.check.crossing_text import crossings_document, crossings_line
from balloon_usd.check.crossings import CrossingReport, count_crossings
from balloon_usd.check.document import document_of
from balloon_usd.check.fault import Fault
from balloon_usd.check.opening import UnreadableError
from balloon_usd.check.report import Report
from balloon_usd.check.text import text_of

__all__ = [
    "CrossingReport",
    "Fault",
    "Report",
    "UnreadableError",
    "check_file",
    "count_crossings",
    "crossings_document",
    "crossings_line",
    "document_of",
    "text_of",
]
