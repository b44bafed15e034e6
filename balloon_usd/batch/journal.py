"""`batch.jsonl`: what became of every recipe of an output folder, a line each."""

from __future__ import annotations

import errno
import os
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.batch.error import NotKept
from balloon_usd.batch.record import Record, Status
from balloon_usd.files.hidden import matching
from balloon_usd.files.lock import locked, remove_unheld
from balloon_usd.files.whole_file import PARTIAL, write_whole

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

FILE_NAME = "batch.jsonl"


class Journal:
    """The records of an output folder, kept on disk as they come, so that a killed run loses none.

    Several runs may write to one folder at once: each line is added under a lock, and the last run to end
    puts all of them in order.
    """

    def __init__(self, folder: Path) -> None:
        """Read what is there; lines that are cut short or from elsewhere count for nothing.

        Raises:
            OSError: it cannot be read, or is no file.
        """
        self._folder = folder
        self._file = folder / FILE_NAME
        if self._file.exists() and not self._file.is_file():
            raise OSError(errno.EINVAL, "cannot be read, it is no file", str(self._file))
        self._records = _by_key(self._read())

    def of(self, name: str) -> Record | None:
        """Return the last record of a sculpture's name."""
        return self._records.get(("name", name))

    def add(self, record: Record) -> None:
        """Keep a record on disk.

        Raises:
            NotKept: it cannot be written.
        """
        self._records[_key(record)] = record
        line = record.line().encode("utf-8", "surrogateescape")
        with self._writing(), self._file.open("ab+") as file:
            # A line that was cut short must not swallow this one.
            if file.tell() and not _ends_a_line(file.fileno(), file.tell()):
                line = b"\n" + line
            file.write(line)

    def put_in_order(self, recipes: Iterable[str]) -> None:
        """Leave one line of every recipe: first those of this run in their order, then the others by name.

        Raises:
            NotKept: the file cannot be written.
        """
        with self._writing():
            found = _by_key(self._read())
            order = {recipe: number for number, recipe in enumerate(recipes)}
            last = len(order)
            lines = sorted(found.values(), key=lambda r: (order.get(r.recipe, last), r.recipe, r.name))
            self._sweep()
            if lines:
                text = "".join(record.line() for record in lines)
                write_whole({self._file: text.encode("utf-8", "surrogateescape")})

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            with locked(self._folder):
                yield
        except OSError as error:
            raise NotKept(f"{self._file} cannot be written: {error.strerror or error}") from error

    def _sweep(self) -> None:
        """Remove what killed runs left of the file while they put it in order."""
        for partial in matching(self._folder, f".{FILE_NAME}.????????{PARTIAL}"):
            remove_unheld(partial)

    def _read(self) -> list[Record]:
        try:
            text = self._file.read_bytes().decode("utf-8", "surrogateescape")
        except FileNotFoundError:
            return []
        records = (Record.read(line) for line in text.split("\n"))
        return [record for record in records if record is not None]


def _by_key(records: Iterable[Record]) -> dict[tuple[str, str], Record]:
    found: dict[tuple[str, str], Record] = {}
    for record in records:
        # A recipe that is made at last was perhaps refused before.
        found.pop(_file(record), None)
        found[_key(record)] = record
    return found


def _key(record: Record) -> tuple[str, str]:
    """Return by what a later record takes the place of this one: what was made by its name."""
    return ("name", record.name) if record.status is Status.DONE else _file(record)


def _file(record: Record) -> tuple[str, str]:
    """Return the key of a recipe's file, however it was named."""
    return ("recipe", str(Path(record.recipe).absolute()))


def _ends_a_line(descriptor: int, size: int) -> bool:
    return os.pread(descriptor, 1, size - 1) == b"\n" if hasattr(os, "pread") else True
