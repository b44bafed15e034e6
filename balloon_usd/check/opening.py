"""Opening a stage with all layers that any of its variants needs, or saying in a line why not."""

from __future__ import annotations

import re
from math import isfinite
from pathlib import Path
from typing import Any

from balloon_usd.openusd import Ar, Sdf, Tf, Usd, UsdGeom
from balloon_usd.stage.on_disk import is_cut_package, special_files
from balloon_usd.stage.opening import said_by

WRONG_TEXT = re.compile(r":(\d+):(\d+): ")
"""Line and column in what USD says about a text layer."""

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")


class UnreadableError(Exception):
    """A stage cannot be read; the message is one line that says why."""


def open_whole(file: Path) -> Any:
    """Open a stage that shows something and has frames.

    Raises:
        UnreadableError: the file, or one that it needs in some variant, is missing or no USD; nothing is
            shown; the range of time codes is empty.
    """
    layer = _layer(str(file), f"{file}:")
    for asset, by in special_files(layer):
        raise UnreadableError(f"{file}: {asset}, which {by} needs: is a pipe or a device, expected a file")
    _require_layers(layer, str(file))
    stage = Usd.Stage.Open(str(file))
    shown = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    if not any(prim.IsA(UsdGeom.Gprim) for prim in shown):
        raise UnreadableError(f"{file}: shows no mesh")
    root, start, end = stage.GetRootLayer(), stage.GetStartTimeCode(), stage.GetEndTimeCode()
    authored = root.HasStartTimeCode() and root.HasEndTimeCode() and isfinite(start) and isfinite(end)
    if authored and end < start:
        raise UnreadableError(f"{file}: has no frames, its time codes are {start:g} to {end:g}")
    return stage


def _layer(path: str, what: str) -> Any:
    """Open a layer.

    Raises:
        UnreadableError: with `what` before the reason.
    """
    # A layer may be named with arguments for its format, or lie in a package.
    whole = Path(Ar.SplitPackageRelativePathOuter(Sdf.Layer.SplitIdentifier(path)[0])[0])
    try:
        with whole.open("rb") as file:
            if not file.read(1):
                raise UnreadableError(f"{what} the file is empty")
        layer = Sdf.Layer.FindOrOpen(path)
        if layer and is_cut_package(whole):
            raise UnreadableError(f"{what} no USD file, or a truncated one")
    except FileNotFoundError as error:
        raise UnreadableError(f"{what} the file is missing") from error
    except OSError as error:
        raise UnreadableError(f"{what} cannot be read ({error.strerror or error})") from error
    except Tf.ErrorException as error:
        raise UnreadableError(f"{what} {_reason(path, error)}") from error
    if layer is None:
        raise UnreadableError(f"{what} {_reason(path, None)}")
    return layer


def _reason(path: str, error: Any) -> str:
    """Why a file that exists cannot be opened."""
    if not path.lower().rstrip("]").endswith(SUFFIXES):
        return f"no USD file, expected one of {', '.join(SUFFIXES)}"
    said = said_by(error) if error else ""
    place = WRONG_TEXT.search(said)
    if place:
        return f"wrong text at line {place[1]}, column {place[2]}"
    cause = "truncated" if "truncated" in said else "damaged"
    return f"no USD file, or a {cause} one"


def _require_layers(root: Any, name: str) -> None:
    """Open every layer that a layer needs, in whatever variant.

    Raises:
        UnreadableError: one is missing or cannot be read.
    """
    seen, waiting = {root.identifier}, [root]
    while waiting:
        layer = waiting.pop()
        # A reference within a layer names no file.
        for asset in sorted({*layer.GetCompositionAssetDependencies()} - {""}):
            path = Sdf.ComputeAssetPathRelativeToLayer(layer, asset)
            if path in seen:
                continue
            seen.add(path)
            needs = f"{name}: {asset}, which {layer.GetDisplayName()} needs:"
            waiting.append(_layer(path, needs))
