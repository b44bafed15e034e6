"""Physics-true balloon twisting: a YAML recipe becomes an animated USD stage."""

from __future__ import annotations

__version__ = "0.1.0"
