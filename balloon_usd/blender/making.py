# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of the command beside Blender: how far it is, what it told, and its end."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from threading import Thread
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from .command import surroundings

if TYPE_CHECKING:
    from collections.abc import Sequence

GRACE = 2.0
"""Time to tidy up before the program is killed (s)."""
PROGRESS = re.compile(r"progress (\d+)/(\d+) ?(.*)")
STAGE = re.compile(r"stage (.+)")
# The group of processes is stopped as one: uvx starts another.
if sys.platform == "win32":
    APART: dict[str, Any] = {
        "creationflags": subprocess.CREATE_NEW_PROCESS_GROUP | subprocess.CREATE_NO_WINDOW
    }
else:
    APART: dict[str, Any] = {"start_new_session": True}


class Progress(NamedTuple):
    """How far a run is."""

    done: int
    total: int
    """Both in frames; zero before it begins."""
    doing: str

    @property
    def share(self) -> float:
        """From 0 to 1."""
        return self.done / self.total if self.total else 0.0


class Making:
    """A running program."""

    def __init__(self, words: Sequence[str], folder: Path) -> None:
        """Start the words in a folder; raises `OSError` when they cannot be started."""
        self.progress = Progress(0, 0, "starting")
        self.told: list[str] = []
        """Lines for people, from the error stream."""
        self.stage: Path | None = None
        """The file that was written, once it is."""
        self._process = subprocess.Popen(  # noqa: S603
            words,
            cwd=folder,
            env=surroundings(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            errors="replace",
            **APART,
        )
        self._readers = [
            Thread(target=_read, args=(stream, take), daemon=True)
            for stream, take in ((self._process.stdout, self._written), (self._process.stderr, self._heard))
        ]
        for reader in self._readers:
            reader.start()

    @property
    def running(self) -> bool:
        """Whether it goes on."""
        return self._process.poll() is None

    def wait(self) -> int:
        """Wait for the end and for all that was told; return the exit code."""
        code = self._process.wait()
        for reader in self._readers:
            reader.join()
        return code

    def cancel(self) -> None:
        """Interrupt it, as Ctrl-C does, and kill what has not ended then."""
        if not self.running:
            return
        self._stop(gently=True)
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(GRACE)
        self._stop(gently=False)
        self.wait()

    def _stop(self, *, gently: bool) -> None:
        if sys.platform == "win32":
            words = ["taskkill", "/T", "/F", "/PID", str(self._process.pid)]
            subprocess.run(words, check=False, capture_output=True)  # noqa: S603
        else:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGINT if gently else signal.SIGKILL)

    def _written(self, line: str) -> None:
        if match := STAGE.fullmatch(line):
            self.stage = self.stage or Path(match[1])

    def _heard(self, line: str) -> None:
        if match := PROGRESS.fullmatch(line):
            self.progress = Progress(int(match[1]), int(match[2]), match[3])
        elif line:
            self.told.append(line)


def _read(stream: IO[str], take: Any) -> None:
    with stream:
        for line in stream:
            take(line.rstrip())
