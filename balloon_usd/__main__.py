"""`python -m balloon_usd`."""

from __future__ import annotations

from balloon_usd.cli import main

if __name__ == "__main__":
    main(prog_name="balloon-usd")
