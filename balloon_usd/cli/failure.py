"""How a command ends when it cannot do what was asked: one message, one exit code."""

from __future__ import annotations

from enum import IntEnum
from typing import IO, Any

import click


class ExitCode(IntEnum):
    """Exit codes of all commands, as documented in `--help`."""

    NOT_WRITTEN = 1
    BAD_INPUT = 2
    SIMULATION_FAILED = 3
    INTERRUPTED = 130
    UNHEARD = 141
    TERMINATED = 143


EXIT_CODES_HELP = """\b
Exit codes:
  0    done
  1    a result could not be written, as on a full disk
  2    bad input: recipe, stage, option, device or output folder
  3    the simulation failed; `run` leaves the frames before that as NAME.failed
  130  interrupted
  141  nobody read the output any more (a closed pipe)
  143  terminated (SIGTERM, or SIGHUP as its terminal was closed)
"""


class Failure(click.ClickException):
    """Ends a command with a message for people and an exit code for programs."""

    def __init__(self, message: str, code: ExitCode) -> None:
        super().__init__(message)
        self.exit_code = int(code)  # type: ignore[misc]  # click's is one a class

    def __reduce__(self) -> tuple[type[Failure], tuple[str, ExitCode]]:
        """Travel between processes."""
        return Failure, (self.message, ExitCode(self.exit_code))

    def show(self, file: IO[Any] | None = None) -> None:
        """Print the message as it is: lines that begin with file:line:column lead editors to the place."""
        click.echo(self.message, file=file, err=True)
