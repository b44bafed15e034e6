"""The group of commands and what they have in common."""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click

from balloon_usd.cli.bench import bench
from balloon_usd.cli.blender_extension import blender_extension
from balloon_usd.cli.check import check
from balloon_usd.cli.diff import diff
from balloon_usd.cli.export import export
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.farm_task import farm_task
from balloon_usd.cli.farm_template import farm_template
from balloon_usd.cli.golden import golden
from balloon_usd.cli.plan import plan
from balloon_usd.cli.preview import preview
from balloon_usd.cli.run import run
from balloon_usd.cli.schema import schema
from balloon_usd.cli.streams import complete_streams
from balloon_usd.cli.vary import vary
from balloon_usd.endings import TERMINATING, Terminated, never_dropped, terminate
from balloon_usd.loading import expect_modules
from balloon_usd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator


class Commands(click.Group):
    """A group whose commands end without a traceback when interrupted, or when nobody hears them."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run the program, whatever its standard streams are."""
        complete_streams()
        return super().main(*args, **kwargs)

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        """Read the words of the command line; some, as `--help`, are answered at once."""
        with _heard():
            return super().make_context(*args, **kwargs)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; Ctrl-C ends it with its own exit code."""
        try:
            with _heard(), _terminable(), never_dropped(KeyboardInterrupt, Terminated):
                return super().invoke(ctx)
        except KeyboardInterrupt as error:
            raise Failure("interrupted, nothing half-written is left", ExitCode.INTERRUPTED) from error
        except Terminated as error:
            raise Failure("terminated, nothing half-written is left", ExitCode.TERMINATED) from error


@contextmanager
def _terminable() -> Iterator[None]:
    """Let SIGTERM and SIGHUP end the block as an exception does, so that nothing half-written is left."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    # A command that is started by nohup outlives its terminal.
    heeded = [number for number in TERMINATING if signal.getsignal(number) != signal.SIG_IGN]
    before = {number: signal.signal(number, terminate) for number in heeded}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def _heard() -> Iterator[None]:
    """Tell in one line when the disk behind the output is full; end when nobody reads it any more."""
    try:
        yield
    except OSError as error:
        # What is said goes to a stream without a name.
        if error.errno not in (errno.ENOSPC, errno.EFBIG, errno.EPIPE) or error.filename is not None:
            raise
        # What waits in the buffer goes nowhere: Python would try once more as it ends.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
        if error.errno == errno.EPIPE:
            raise click.exceptions.Exit(ExitCode.UNHEARD) from error
        raise Failure(f"nothing more can be said: {error.strerror}", ExitCode.BAD_INPUT) from error


@click.group(cls=Commands, epilog=EXIT_CODES_HELP, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="balloon-usd")
def main() -> None:
    """Physics-true balloon twisting: a YAML recipe becomes an animated USD stage."""
    expect_modules()


for command in (
    run,
    plan,
    vary,
    schema,
    preview,
    check,
    diff,
    golden,
    export,
    farm_template,
    farm_task,
    blender_extension,
    bench,
):
    main.add_command(command)
