"""A stand-in for what makes a chunk: slow, with files that are whole or not there, and that are never made twice."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class ChunkTask:
    """Makes `NAME.done` of each recipe in a shared folder, and notes the process of each beginning in `NAME.begun`."""

    folder: Path
    seconds: float = 0.0
    """For each recipe."""
    error: type[Exception] | None = None
    """Raised by the first attempt at each recipe."""
    deadly: str = ""
    """Name of a recipe that kills its process, whenever it is tried."""

    def __call__(self, chunk):
        return [self._make(name) for name in chunk]

    def _make(self, name):
        done = self.folder / f"{name}.done"
        if done.exists():
            return {"name": name, "status": "skipped"}
        self._begin(name)
        try:
            self._wait()
        except KeyboardInterrupt:
            (self.folder / f"{name}.interrupted").touch()
            raise
        partial = self.folder / f".{name}.{os.getpid()}.partial"
        partial.write_text(name)
        partial.replace(done)
        return {"name": name, "status": "done", "gpus": os.environ.get("CUDA_VISIBLE_DEVICES")}

    def _wait(self):
        # In short steps: what ends a task is heard between them.
        end = time.monotonic() + self.seconds
        while time.monotonic() < end:
            time.sleep(0.02)

    def _begin(self, name):
        begun = self.folder / f"{name}.begun"
        first = not begun.exists()
        with begun.open("a") as file:
            file.write(f"{os.getpid()}\n")
        if name == self.deadly:
            os.kill(os.getpid(), signal.SIGKILL)
        if first and self.error:
            raise self.error(f"{name} was lost")
