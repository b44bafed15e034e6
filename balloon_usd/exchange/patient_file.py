"""A file for HDF5, which crashes where a disk is full: what fails is kept until it can be told."""

from __future__ import annotations

from typing import IO


class PatientFile:
    """A binary file that takes every write; `require_whole` tells of the first one that failed."""

    def __init__(self, file: IO[bytes]) -> None:
        """Stand before an open file that can be read and written."""
        self._file = file
        self._error: OSError | None = None

    def require_whole(self) -> None:
        """Check that all has been written so far.

        Raises:
            OSError: something was not.
        """
        if self._error is not None:
            raise self._error

    def write(self, data: bytes) -> int:
        """Write, as `io.RawIOBase` does."""
        try:
            return self._file.write(data)
        except OSError as error:
            self._error = self._error or error
            return len(data)

    def truncate(self, size: int) -> int:
        """Change the length, as `io.RawIOBase` does."""
        try:
            return self._file.truncate(size)
        except OSError as error:
            self._error = self._error or error
            return size

    def flush(self) -> None:
        """Do nothing: writes are not held back."""

    def read(self, size: int = -1) -> bytes:
        """Read, as `io.RawIOBase` does."""
        return self._file.read(size)

    def readinto(self, room: memoryview) -> int:
        """Read, as `io.RawIOBase` does."""
        data = self.read(len(room))
        room[: len(data)] = data
        return len(data)

    def seek(self, offset: int, whence: int = 0) -> int:
        """Go to a place, as `io.RawIOBase` does."""
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        """Return the place, as `io.RawIOBase` does."""
        return self._file.tell()
