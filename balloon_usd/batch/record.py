"""What became of a recipe: one line of `batch.jsonl`."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any

from balloon_usd.version import __version__

if TYPE_CHECKING:
    from balloon_usd.batch.facts import Facts
    from balloon_usd.batch.messages import Made
    from balloon_usd.batch.order import Order


class Status(StrEnum):
    """How a recipe ended."""

    DONE = "done"
    SKIPPED = "skipped"
    """It was there already, whole; its line stays that of the run that made it."""
    REFUSED = "refused"
    NOT_WRITTEN = "not written"
    FAILED = "simulation failed"
    UNFORESEEN = "unforeseen error"
    KILLED = "killed"
    DEVICE = "device failed"


@dataclass(frozen=True)
class Record:
    """What became of one recipe."""

    recipe: str
    """Its file, as it was named."""
    name: str
    """Of the sculpture; "" where it could not be read."""
    status: Status
    made_of: dict[str, str] = field(default_factory=dict)
    """Hashes of the recipe's text and its meshes, versions of the solver and of this program."""
    options: dict[str, Any] = field(default_factory=dict)
    """Detail, form, look, shot and range of frames."""
    device: str = ""
    frames: int = 0
    seconds: float = 0.0
    """From the first frame to the last file."""
    size: int = 0
    """Of the stage's files [B]."""
    summary: dict[str, Any] = field(default_factory=dict)
    """Flat tail left [m], highest stretch, what would burst, what came undone, and the quality."""
    products: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Files of the stage, the shot, the report and the contact sheet, where there are any."""
    files: dict[str, str] = field(default_factory=dict)
    """SHA-256 of all files by path below the output folder."""
    error: str = ""

    def line(self) -> str:
        """Return the line of `batch.jsonl`."""
        return json.dumps(asdict(self), ensure_ascii=False) + "\n"

    @staticmethod
    def read(line: str) -> Record | None:
        """Return what a line says; None for one that is cut short or from elsewhere."""
        try:
            return record_of(json.loads(line))
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            return None

    def fits(self, facts: Facts, order: Order, device: str) -> bool:
        """Whether what it tells of is just what is asked for now.

        `device`: cpu or cuda where one was asked for, whose results differ in the last digits; else "".
        """
        asked = {"stage", *(["report"] if order.report else []), *(["sheet"] if order.preview else [])}
        return (
            self.status is Status.DONE
            and self.name == facts.name
            and self.made_of == made_of(facts.provenance)
            and self.options == options_of(order)
            and (not device or self.device.split(":")[0] == device)
            and asked <= {key for key, files in self.products.items() if files}
        )


def record_of(told: dict[str, Any]) -> Record:
    """Return the record that a dictionary tells of, as `dataclasses.asdict` makes one."""
    products = {key: tuple(files) for key, files in told["products"].items()}
    if not all(isinstance(text, str) for text in (told["recipe"], told["name"], *told["files"].values())):
        raise TypeError("no names and hashes of files")
    return Record(**{**told, "status": Status(told["status"]), "products": products})


def made_of(provenance: dict[str, str]) -> dict[str, str]:
    """Return what decides the bytes of a stage besides the options."""
    return {**provenance, "version": __version__}


def options_of(order: Order) -> dict[str, Any]:
    """Return the options that decide the bytes of a stage."""
    return {**order.form, "frames": str(order.frames)}


def done(recipe: str, facts: Facts, order: Order, device: str, made: Made) -> Record:
    """Return the record of a recipe that was made."""
    return Record(
        recipe,
        facts.name,
        Status.DONE,
        made_of(facts.provenance),
        options_of(order),
        device,
        made.frames,
        round(made.seconds, 3),
        made.size,
        made.summary,
        made.products,
        made.files,
    )


def failed(recipe: str, facts: Facts, order: Order, device: str, made: Made) -> Record:
    """Return the record of a recipe whose simulation failed after some frames, which are kept."""
    kept = done(recipe, facts, order, device, made)
    return replace(kept, status=Status.FAILED, error=f"{recipe}: simulation failed {made.failed}")


def skipped(record: Record, recipe: str) -> Record:
    """Return the record of a recipe that was there already."""
    return replace(record, recipe=recipe, status=Status.SKIPPED)
