"""Other details of the same sculpture, written by earlier runs: they stay, as further variants."""

from __future__ import annotations

import filecmp
import os
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pxr import Sdf, Tf

from balloon_usd.stage.interface import EXTENTS_HINT, VARIANT_SET
from balloon_usd.stage.provenance import KEY
from balloon_usd.stage.wire_texture import FILE_NAME, wire_png

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

MATERIALS = Path("payload", "materials.usda")
TEXTURE = Path("payload", FILE_NAME)


@dataclass(frozen=True)
class Earlier:
    """What an asset folder holds besides the detail that is written now."""

    kept: dict[str, NDArray[np.float32]] = field(default_factory=dict)
    """Details that show the same recipe, and the room they take (2, 3) [m]."""
    stale: tuple[str, ...] = ()
    """Details of another recipe text, colour or length: they would show another sculpture."""


def detail_files(detail: str) -> tuple[Path, Path, Path]:
    """Files of one detail, relative to the asset: payload, samples, geometry."""
    payload = Path("payload")
    return payload / f"{detail}.usda", payload / f"{detail}_sim.usdc", payload / f"{detail}_geo.usdc"


def find_earlier(asset: Path, built: Path, name: str, written: str) -> Earlier:
    """Look through the asset folder for details other than the one that was just built."""
    try:
        interface = Sdf.Layer.OpenAsAnonymous(str(asset / f"{name}.usda"))
        variants = dict(interface.GetPrimAtPath(f"/{name}").variantSets[VARIANT_SET].variants)
    except (Tf.ErrorException, AttributeError, KeyError):
        return Earlier()
    materials = asset / MATERIALS
    fits = materials.is_file() and filecmp.cmp(materials, built / MATERIALS, shallow=False)
    kept: dict[str, NDArray[np.float32]] = {}
    stale = []
    for detail, variant in sorted(variants.items()):
        hint = variant.primSpec.attributes.get(EXTENTS_HINT)
        if detail == written:
            continue
        if hint and fits and _head(asset, detail) == _head(built, written):
            kept[detail] = np.array(hint.default, dtype=np.float32)
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
    """What two details must have in common: recipe, rate and range; None without readable samples."""
    payload, samples, geometry = (asset / file for file in detail_files(detail))
    if not (payload.is_file() and geometry.is_file()):
        return None
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(samples), metadataOnly=True)
    except Tf.ErrorException:
        return None
    facts = layer.customLayerData.get(KEY, {})
    return facts.get("recipe_sha256"), layer.timeCodesPerSecond, layer.startTimeCode, layer.endTimeCode


def _link_or_copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:
        # File systems without hard links, and platforms that do not link symbolic links.
        shutil.copy2(source, target, follow_symlinks=False)
