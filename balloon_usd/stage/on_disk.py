"""What stands on disk where a stage should: which file is meant, and whether USD can read it."""

from __future__ import annotations

import re
import stat
import zipfile
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf, Tf, UsdUtils

if TYPE_CHECKING:
    from collections.abc import Iterator

CONTROL = re.compile(r"[\x00-\x1f\x7f]")
"""Characters that no path may hold."""


def file_of(path: Path) -> Path:
    """Return the file that a path stands for: NAME/NAME.usda of a folder NAME, else itself.

    Raises:
        OSError: the path cannot be looked up, as one that is too long.
    """
    # The folder one stands in has a name only when it is resolved.
    folder = path if path.name not in {"", ".."} else path.resolve()
    return folder / f"{folder.name}.usda" if path.is_dir() else path


def why_not_named(path: Path) -> str:
    """Return in one line why USD can open no file of this name, "" if it can.

    USD takes paths as text in UTF-8, without control characters.
    """
    shown = CONTROL.sub(lambda found: repr(found[0])[1:-1], str(path))
    try:
        text = str(path.absolute())
        text.encode("utf-8")
    except OSError as error:
        return f"{shown}: {error.strerror}"
    except UnicodeEncodeError:
        shown = shown.encode("utf-8", "backslashreplace").decode()
        return f"{shown}: the path is not UTF-8, which USD needs"
    return f"{shown}: the path holds control characters, which USD refuses" if CONTROL.search(text) else ""


def _is_special(path: str) -> bool:
    """Whether a pipe, a device or the like is there, for which USD would wait for ever."""
    try:
        mode = Path(path).stat().st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def is_cut_package(file: Path) -> bool:
    """Whether a `.usdz` has lost its end, the table of its contents, which USD itself does not read.

    Raises:
        OSError: the file cannot be read.
    """
    return file.suffix.lower() == ".usdz" and not zipfile.is_zipfile(file)


def special_files(root: Any) -> Iterator[tuple[str, str]]:
    """Yield each pipe, device or the like that a layer or one below it names in any variant, and by whom."""
    waiting, opened = [root], {root.identifier: root}
    while waiting:
        layer = waiting.pop()
        for asset in sorted({*chain(*UsdUtils.ExtractExternalReferences(layer.identifier))} - {""}):
            path = Sdf.ComputeAssetPathRelativeToLayer(layer, asset)
            if _is_special(path):
                yield asset, layer.GetDisplayName()
            elif path not in opened and asset in layer.GetCompositionAssetDependencies():
                below = opened[path] = _layer_or_none(path)
                waiting += [below] if below else []


def _layer_or_none(path: str) -> Any:
    try:
        return Sdf.Layer.FindOrOpen(path)
    except Tf.ErrorException:
        return None
