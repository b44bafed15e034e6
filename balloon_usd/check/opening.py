"""Opening a stage with all layers that any of its variants needs, or saying in a line why not."""

from __future__ import annotations

import re
from contextlib import contextmanager
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pxr import Ar, Sdf, Tf, Usd, UsdGeom, UsdUtils

from balloon_usd.stage.properties.reading import said_by

if TYPE_CHECKING:
    from collections.abc import Iterator

WRONG_TEXT = re.compile(r":(\d+):(\d+): ")
"""Line and column in what USD says about a text layer."""

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")


class UnreadableError(Exception):
    """A stage cannot be read; the message is one line that says why."""


@contextmanager
def quiet() -> Iterator[None]:
    """Keep USD's own warnings from the error stream: what they are about is found out otherwise."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        delegate.TakeUncoalescedDiagnostics()
        del delegate


def open_whole(file: Path) -> Any:
    """Open a stage that shows something and has frames.

    Raises:
        UnreadableError: the file, or one that it needs in some variant, is missing or no USD; nothing is
            shown; the range of time codes is empty.
    """
    _require_layers(_layer(str(file), f"{file}:"), str(file))
    stage = Usd.Stage.Open(str(file))
    if not any(prim.IsA(UsdGeom.Gprim) for prim in stage.Traverse()):
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
    try:
        if not Ar.IsPackageRelativePath(path):
            with Path(path).open("rb") as file:
                if not file.read(1):
                    raise UnreadableError(f"{what} the file is empty")
        layer = Sdf.Layer.FindOrOpen(path)
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
