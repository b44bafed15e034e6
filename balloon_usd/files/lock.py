"""A lock file says whether the run that made a temporary folder still lives.

The lock goes with its process, however that ends; a process number in a file name would not do,
since numbers are reused and mean nothing on another host or in another container.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import IO, TYPE_CHECKING

if sys.platform != "win32":
    import fcntl

if TYPE_CHECKING:
    from pathlib import Path


def hold(lock: Path) -> IO[bytes]:
    """Create the lock file and hold it until the returned file is closed."""
    file = lock.open("wb")
    if sys.platform != "win32":
        # Some network file systems know no locks: there nothing is swept, see is_held.
        with suppress(OSError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return file


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
