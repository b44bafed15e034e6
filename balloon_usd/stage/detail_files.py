"""Where the files of an asset lie, relative to its folder."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from balloon_usd.stage.looks import STRESS
from balloon_usd.stage.variant_sets import FINISHED
from balloon_usd.stage.wire_texture import FILE_NAME

PAYLOAD = Path("payload")
MATERIALS = PAYLOAD / "materials.usda"
TEXTURE = PAYLOAD / FILE_NAME


class DetailFiles(NamedTuple):
    """Files of one detail."""

    payload: Path
    """The animation: stacks the layers below."""
    samples: Path
    geometry: Path
    finished: Path
    """The finished sculpture: stacks all but the samples."""
    stress: Path
    """Stretch as a colour."""


def detail_files(detail: str) -> DetailFiles:
    """Files of one detail."""
    endings = (".usda", "_sim.usdc", "_geo.usdc", f"_{FINISHED}.usda", f"_{STRESS}.usdc")
    return DetailFiles(*(PAYLOAD / f"{detail}{ending}" for ending in endings))
