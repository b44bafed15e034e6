"""Other details of the same sculpture, written by earlier runs: they stay, as further variants."""

from __future__ import annotations

import filecmp
import os
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.openusd import Sdf, Tf
from balloon_usd.stage.detail_files import MATERIALS, TEXTURE, detail_files
from balloon_usd.stage.interface import read_extents
from balloon_usd.stage.provenance import KEY
from balloon_usd.stage.variant_sets import DETAIL
from balloon_usd.stage.wire_texture import wire_png

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.stage.interface import Extents


@dataclass(frozen=True)
class Earlier:
    """What an asset folder holds besides the detail that is written now."""

    kept: dict[str, Extents] = field(default_factory=dict)
    """Details that show the same recipe, and the room they take."""
    stale: tuple[str, ...] = ()
    """Details of another recipe text, colour or length: they would show another sculpture."""


def find_earlier(asset: Path, built: Path, name: str, written: str) -> Earlier:
    """Look through the asset folder for details other than the one that was just built."""
    try:
        interface = Sdf.Layer.OpenAsAnonymous(str(asset / f"{name}.usda"))
        details = list(interface.GetPrimAtPath(f"/{name}").variantSets[DETAIL].variants.keys())
    except (Tf.ErrorException, AttributeError, KeyError):
        return Earlier()
    materials = asset / MATERIALS
    fits = materials.is_file() and filecmp.cmp(materials, built / MATERIALS, shallow=False)
    kept: dict[str, Extents] = {}
    stale = []
    for detail in sorted({*details} - {written}):
        extents = read_extents(interface, name, detail)
        if extents and fits and _head(asset, detail) == _head(built, written):
            kept[detail] = extents
        else:
            stale.append(detail)
    return Earlier(kept, tuple(stale))


def orphaned_texture(asset: Path) -> list[Path]:
    """The texture of the wire, if an earlier run left it; somebody's own file of that name is none."""
    file = asset / TEXTURE
    return [TEXTURE] if file.is_file() and file.read_bytes() == wire_png() else []


def carry_over(asset: Path, built: Path, leave_out: Iterable[Path]) -> None:
    """Bring every file of the earlier asset folder that the built one lacks, whoever put it there."""
    left_out = set(leave_out)
    for folder, _, names in os.walk(asset):
        for name in sorted(names):
            source = Path(folder, name)
            relative = source.relative_to(asset)
            if relative not in left_out and not (built / relative).exists():
                _link_or_copy(source, built / relative)


def _head(asset: Path, detail: str) -> tuple[object, ...] | None:
    """What two details must have in common: recipe, layout, rate and range; None without readable samples."""
    files = detail_files(detail)
    if not all((asset / file).is_file() for file in files):
        return None
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(asset / files.samples), metadataOnly=True)
    except Tf.ErrorException:
        return None
    facts = layer.customLayerData.get(KEY, {})
    rate, first, last = layer.timeCodesPerSecond, layer.startTimeCode, layer.endTimeCode
    return facts.get("recipe_sha256"), facts.get("schema"), rate, first, last


def _link_or_copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:
        # File systems without hard links, and platforms that do not link symbolic links.
        shutil.copy2(source, target, follow_symlinks=False)
