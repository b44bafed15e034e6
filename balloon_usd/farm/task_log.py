"""The log of a task: lines of progress are told as a farm reads them."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import TextIO

PROGRESS = re.compile(r"progress (\d+)/(\d+) (.*)")
"""What `balloon-usd run --progress lines` writes."""


class TaskLog(io.TextIOBase):
    """A stream that passes lines on, but those of progress as OpenJD's percentage and status."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._begun = ""
        self._told: dict[str, str] = {}

    def write(self, text: str) -> int:
        """Take text; what is no whole line waits for its end."""
        *lines, self._begun = (self._begun + text).split("\n")
        for line in lines:
            self._pass_on(line)
        return len(text)

    def flush(self) -> None:
        """Pass on what has been told so far."""
        self._stream.flush()

    def close(self) -> None:
        """Pass on a last line without an end; the stream behind stays open."""
        if self._begun:
            self.write("\n")
        super().close()

    def _pass_on(self, line: str) -> None:
        match = PROGRESS.fullmatch(line)
        if not match:
            self._stream.write(f"{line}\n")
            return
        done, total, doing = match.groups()
        self._tell("progress", f"{100 * int(done) / max(int(total), 1):.0f}")
        self._tell("status", doing)

    def _tell(self, kind: str, value: str) -> None:
        if value and self._told.get(kind) != value:
            self._told[kind] = value
            self._stream.write(f"openjd_{kind}: {value}\n")
