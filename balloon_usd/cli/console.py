"""What is said in tables and bars."""

from __future__ import annotations

from typing import NoReturn

from rich.console import Console


class Terminal(Console):
    """A console that leaves a closed pipe to the command, as any other output does: Rich ends with code 1."""

    def on_broken_pipe(self) -> NoReturn:
        """Let the error go on; called while it is handled."""
        raise  # noqa: PLE0704
