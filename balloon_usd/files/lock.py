"""A lock file says whether the run that made a temporary folder still lives.

The lock goes with its process, however that ends; a process number in a file name would not do,
since numbers are reused and mean nothing on another host or in another container.
"""

from __future__ import annotations

import os
import sys
from contextlib import contextmanager, suppress
from typing import IO, TYPE_CHECKING

if sys.platform != "win32":
    import fcntl

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other runs from changing names in a folder during the block, where its file system knows locks."""
    if sys.platform == "win32":
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def hold(lock: Path) -> IO[bytes]:
    """Create the lock file and hold it until the returned file is closed."""
    while True:
        file = lock.open("wb")
        if sys.platform == "win32":
            return file
        # Some network file systems know no locks: there nothing is swept, see is_held. Others hold it for a
        # moment only, to see whether it is held, and perhaps remove it.
        with suppress(OSError):
            fcntl.flock(file, fcntl.LOCK_EX)
        if os.fstat(file.fileno()).st_nlink:
            return file
        file.close()


def is_held(lock: Path) -> bool:
    """Whether a living process holds the lock file; a missing file is held by nobody."""
    try:
        if sys.platform == "win32":
            # Windows does not delete a file that is open in any process.
            lock.unlink()
        else:
            with lock.open("rb") as file:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except OSError:
        return True
    return False


def remove_unheld(file: Path) -> None:
    """Remove a file, unless a living process holds it as its lock."""
    with suppress(OSError):
        if sys.platform == "win32":
            file.unlink()
            return
        with file.open("rb") as opened:
            fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
            file.unlink()
