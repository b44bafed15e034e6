# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of `balloon-usd`, and surroundings that are not Blender's."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

FOREIGN = ("PYTHONPATH", "PYTHONHOME", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")
"""Variables that lead another Python to Blender's modules and libraries."""

SILENT = ("--progress", "lines", "--no-preview", "--no-report")


class CommandMissingError(Exception):
    """There is no such program; says what to do."""


def surroundings() -> dict[str, str]:
    """Return the environment for a program that is not part of Blender and writes UTF-8."""
    kept = {name: value for name, value in os.environ.items() if name not in FOREIGN}
    return {**kept, "PYTHONUTF8": "1"}


def split_command(command: str) -> list[str]:
    r"""Part a command into words; quotes keep blanks together, and \ parts folders on Windows."""
    if sys.platform == "win32":
        return [word.strip('"') for word in shlex.split(command, posix=False)]
    return shlex.split(command)


def run_words(command: str, recipe: Path, options: Sequence[str]) -> list[str]:
    """Return the words that make a recipe's stage, to be run in the folder of the recipe.

    Raises:
        CommandMissingError: there is no program of this name.
    """
    try:
        words = split_command(command)
    except ValueError as error:
        raise CommandMissingError(f'The command "{command}" is not complete ({error})') from error
    program = shutil.which(words[0], path=surroundings().get("PATH")) if words else None
    if program is None:
        raise CommandMissingError(
            f'The command "{command}" is not found.\n'
            'Install it ("pip install balloon-usd") and write its whole path into\n'
            "Edit > Preferences > Add-ons > Balloon recipes > Command"
        )
    return [program, *words[1:], "run", *SILENT, *options, "--", recipe.name]
