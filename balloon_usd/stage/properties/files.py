"""Properties 29 and 30: what holds between files and runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.openusd import Tf, Usd, each_step_alone
from balloon_usd.stage.opening import said_by
from balloon_usd.stage.properties.composition import opens_whole
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.timing import one_sample_per_time_code

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


def same_bytes(one: Path, other: Path) -> Iterator[Finding]:
    """Property 29: two runs of one recipe give byte-identical files."""
    files = {file.relative_to(root) for root in (one, other) for file in _files(root)}
    for name in sorted(files):
        pair = [root / name for root in (one, other)]
        missing = [str(file) for file in pair if not file.is_file()]
        if missing:
            yield Finding(29, f"{missing[0]} is missing")
        elif pair[0].read_bytes() != pair[1].read_bytes():
            yield Finding(29, f"{pair[0]} and {pair[1]} differ")


@each_step_alone
def whole_or_absent(folder: Path, name: str) -> Iterator[Finding]:
    """Property 30: whatever ended the run, what has the final name is whole."""
    asset, interface, flat = folder / name, folder / name / f"{name}.usda", folder / f"{name}.usdc"
    if asset.exists() and not interface.is_file():
        yield Finding(30, f"{asset} has no interface file")
    for file in (interface, flat):
        if not file.exists():
            continue
        try:
            stage = Usd.Stage.Open(str(file))
        except Tf.ErrorException as error:
            yield Finding(30, f"{file} does not open: {said_by(error)}")
            continue
        for finding in (*opens_whole(stage), *one_sample_per_time_code(stage)):
            yield Finding(30, f"{file}: {finding}")


def _files(root: Path) -> list[Path]:
    return [root] if root.is_file() else [file for file in root.rglob("*") if file.is_file()]
