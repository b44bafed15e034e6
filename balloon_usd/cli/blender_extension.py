"""`balloon-usd blender-extension`: the extension for Blender as the file that Blender installs."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.output import require_writable


@click.command(epilog=EXIT_CODES_HELP)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    default=Path(),
    help="Folder for the archive; made if need be. Default: here.",
)
def blender_extension(output: Path) -> None:
    """Write the extension that gives Blender File > Import > Balloon recipe (.yaml).

    In Blender: Edit > Preferences > Get Extensions > Install from Disk, and choose the archive. Then write
    the command that is printed here into the preferences of the add-on "Balloon recipes".
    """
    from balloon_usd.cli.extension_archive import archive_name, write_archive  # noqa: PLC0415

    require_writable(output)
    file = output / archive_name()
    if file.is_dir():
        raise Failure(f"{file}: a folder is in the way", ExitCode.BAD_INPUT)
    try:
        write_archive(file)
    except OSError as error:
        raise Failure(
            f"{file}: cannot be written ({error.strerror or error})", ExitCode.NOT_WRITTEN
        ) from error
    click.echo(f"extension {file}")
    click.echo(f"command {_this_command()}")


def _this_command() -> str:
    """Return words that start this very program from anywhere."""
    python = f'"{sys.executable}"' if " " in sys.executable else sys.executable
    return f"{python} -m {__package__.partition('.')[0]}"
