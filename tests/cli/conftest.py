from __future__ import annotations

from tests.command_line import cli, left, solver, write_recipe

__all__ = ["cli", "left", "solver", "write_recipe"]
