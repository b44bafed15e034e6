"""A hidden folder beside the final place, in which an asset grows until it is whole."""

from __future__ import annotations

import secrets
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Self

from balloon_usd.files.hidden import matching
from balloon_usd.files.lock import hold, is_held, locked
from balloon_usd.stage.error import writing

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import TracebackType

SUFFIX = ".writing"
# Names with a dot: no sculpture is called so.
LOCK = "in.use"
PREVIOUS = "previous.asset"


class Workspace:
    """Temporary home of one asset (a folder or a file) and its way to the final name.

    On leaving, whatever was not published is removed. A killed process leaves only a hidden
    folder `.NAME.????????.writing`, which the next run for the same name sweeps.
    """

    def __init__(self, final: Path) -> None:
        """Prepare for `final`, the path that the asset gets when it is whole."""
        self.final = final

    def __enter__(self) -> Self:
        """Make the folder; raises `StageError` when the place cannot be written."""
        with writing(self.final):
            self.final.parent.mkdir(parents=True, exist_ok=True)
            # The link's target is replaced, not the link; a later chdir does no harm.
            self._place = self.final.resolve()
            name, beside = self.final.stem, self._place.parent
            sweep(name, beside)
            # Another run must not sweep the folder before its lock is held.
            with locked(beside):
                self._folder = Path(tempfile.mkdtemp(prefix=f".{name}.", suffix=SUFFIX, dir=beside))
                self._lock = hold(self._folder / LOCK)
        return self

    @property
    def built(self) -> Path:
        """Where the asset is built: a path that does not exist at first."""
        return self._folder / self._place.name

    def rename(self, final: Path) -> None:
        """Give the built asset another final name; raises `StageError` when that cannot be."""
        with writing(final):
            before, self.final, self._place = self.built, final, final.resolve()
            before.rename(self.built)

    def publish(self, beside: Iterable[str] = ()) -> None:
        """Give the built asset its final name, and before that those built beside it; raises `StageError`.

        A file is replaced in one step. A folder takes two renames: a run killed between them
        leaves the earlier asset in the hidden folder, and the next run puts it back.
        """
        # Nor must it take away or publish the same asset between two of these names.
        with writing(self.final), locked(self._place.parent):
            for name in beside:
                self.built.with_name(name).replace(self._place.with_name(name))
            if self.built.is_dir() and self._place.is_dir():
                self.built.chmod(self._place.stat().st_mode)
                (self._folder / PREVIOUS).mkdir()
                self._place.rename(self._folder / PREVIOUS / self._place.name)
            self.built.replace(self._place)

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove the folder, and put an earlier asset back if its successor did not arrive."""
        self._lock.close()
        _remove(self._folder)


def sweep(name: str, beside: Path) -> None:
    """Remove what killed runs of the sculpture `name` left in the folder `beside`."""
    # Mostly there is nothing: no other run is kept waiting while a large folder is looked through.
    found = matching(beside, f".{name}.????????{SUFFIX}")
    if not found:
        return
    with locked(beside):
        for folder in found:
            if not is_held(folder / LOCK):
                _remove(folder)


def discard(asset: Path, name: str) -> None:
    """Remove the folder of an asset in one step; what a kill leaves of it, the next run for `name` sweeps."""
    hidden = asset.with_name(f".{name}.{secrets.token_hex(4)}{SUFFIX}")
    with suppress(OSError):
        asset.rename(hidden)
        _remove(hidden)


def _remove(folder: Path) -> None:
    """Remove a hidden folder, but not an asset that exists nowhere else."""
    for earlier in (folder / PREVIOUS).glob("*"):
        home = folder.parent / earlier.name
        if not home.exists():
            earlier.rename(home)
    shutil.rmtree(folder, ignore_errors=True)
