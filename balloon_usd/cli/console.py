"""What is said in tables and bars."""

from __future__ import annotations

import errno
import os
from typing import NoReturn

from rich.console import Console


class Terminal(Console):
    """A console that leaves a closed pipe to the command, as any other output does: Rich ends with code 1."""

    def on_broken_pipe(self) -> NoReturn:
        """Say so as a stream does."""
        raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))
