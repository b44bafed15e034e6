"""The command line, `balloon-usd`: a module a command, and what they share.

Commands import what they need when they run, so that `--help` answers at once.
"""

from __future__ import annotations

from balloon_usd.cli.group import main

__all__ = ["main"]
