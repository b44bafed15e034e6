"""What the scheduler and its worker processes tell each other; frames themselves lie in shared memory."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.batch.facts import Facts, Refusal
    from balloon_usd.batch.order import Order
    from balloon_usd.solver.status import Status


class Role(Enum):
    """What a worker process is for."""

    SIMULATOR = "simulator"
    WRITER = "writer"
    DRAWER = "drawer"
    """A writer that only draws contact sheets: it holds a context of the GPU, and keeps no frames waiting."""


class Trouble(Enum):
    """Why a recipe was not made."""

    NOT_WRITTEN = "not written"
    """Its stage, report or contact sheet, as on a full disk."""
    FAILED = "simulation failed"
    UNFORESEEN = "unforeseen"
    """An error in this program."""
    KILLED = "killed"
    """The process that made it was, twice."""
    DEVICE = "device"
    """The device has no memory for it, or is gone."""


@dataclass(frozen=True)
class Start:
    """To a new worker: what it is for."""

    role: Role
    order: Order
    device: str


@dataclass(frozen=True)
class Started:
    """From a worker that is ready, or cannot be."""

    device: str = ""
    """Name of the device that was asked for."""
    devices: tuple[str, ...] = ()
    """All CUDA devices that are there."""
    processors: int = 0
    """Multiprocessors of the device; 0 of a CPU."""
    free_bytes: int = 0
    """Free memory of the device; 0 where it is the computer's own."""
    problem: str = ""
    """Why it cannot work."""


@dataclass(frozen=True)
class Survey:
    """To a writer: read and plan recipes."""

    files: tuple[tuple[int, str], ...]
    """Numbers of jobs and the files of their recipes."""


@dataclass(frozen=True)
class Surveyed:
    """From a writer."""

    found: tuple[tuple[int, Facts | Refusal], ...]


@dataclass(frozen=True)
class Verify:
    """To a writer: remove what killed runs left of sculptures, and see whether their files are whole."""

    sculptures: tuple[tuple[int, str, dict[str, str]], ...]
    """Number of the job, name, and SHA-256 by path below the output folder."""


@dataclass(frozen=True)
class Verified:
    """From a writer."""

    whole: tuple[tuple[int, bool], ...]
    """By number of the job."""


@dataclass(frozen=True)
class Part:
    """A sculpture of a batch."""

    job: int
    batch: int
    place: int
    """In the batch."""
    file: str
    origin: dict[str, str]
    """Hashes of the recipe's text and its meshes when it was surveyed, and the version of the solver."""
    last: int
    """Last time code that is wanted."""
    plan: bytes = b""
    """Its plan, see `reading.packed`; empty if that is large."""


@dataclass(frozen=True)
class Simulate:
    """To a simulator."""

    batch: int
    parts: tuple[Part, ...]
    threads: int
    """Of a CPU, at most."""


@dataclass(frozen=True)
class Begin:
    """To a writer: sculptures of a batch whose frames it will get."""

    batch: int
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class LaidOut:
    """From a simulator: how its frames will lie in memory."""

    batch: int
    size: int
    """Of their ring [B]."""
    layout: bytes
    """`FrameLayout`, pickled: the scheduler passes it on and needs none of what it takes to read it."""


@dataclass(frozen=True)
class Ring:
    """To a simulator and its writers: where the frames lie; the handle of the memory follows."""

    batch: int
    size: int
    """Of the ring [B]."""
    layout: bytes
    """`FrameLayout`, pickled."""
    name: str = ""
    """Of the memory, on Windows."""


@dataclass(frozen=True)
class Frames:
    """From a simulator, and on to the writers: consecutive frames in a slot."""

    batch: int
    slot: int
    first: int
    """Time code of the first of them."""
    count: int
    doing: str
    statuses: dict[int, dict[int, Status]] = field(default_factory=dict)
    """What sculptures do and what of them has come undone, by time code and place, where that is news."""
    failed: dict[int, tuple[int, str]] = field(default_factory=dict)
    """By place: the time code from which on there is nothing, and why."""


@dataclass(frozen=True)
class Copied:
    """From a writer: it needs a slot no more."""

    batch: int
    slot: int


@dataclass(frozen=True)
class Free:
    """To a simulator: no writer needs a slot any more."""

    batch: int
    slot: int


@dataclass(frozen=True)
class Simulated:
    """From a simulator: a batch is over; `problem` says why if that is before its end."""

    batch: int
    problem: str = ""
    of_device: bool = False
    """Whether the device is to blame: no memory, or gone."""
    of_recipe: bool = False
    """Whether a recipe was changed since it was surveyed."""
    of_all: bool = False
    """Whether every other batch would end in the same way."""


@dataclass(frozen=True)
class Drop:
    """To a writer or simulator: give up sculptures of a batch, all of them where no jobs are named."""

    batch: int
    jobs: tuple[int, ...] = ()


@dataclass(frozen=True)
class Made:
    """From a writer: a sculpture is on disk, whole and verified, or up to the frame at which it failed."""

    job: int
    batch: int
    """The one in which it was simulated: a job may have been begun anew in another one meanwhile."""
    files: dict[str, str]
    """SHA-256 by path below the output folder; the stage that people open comes first."""
    products: dict[str, tuple[str, ...]]
    """Files of the stage, the shot and the report."""
    frames: int
    size: int
    """Of the stage's files [B]."""
    summary: dict[str, object]
    seconds: float
    """From its first frame to its last file."""
    failed: str = ""
    """Why its simulation ended early, and where the frames before that are; "" if it did not."""

    def with_sheet(self, files: dict[str, str]) -> Made:
        """Return the same with a contact sheet."""
        return replace(self, files=self.files | files, products=self.products | {"sheet": tuple(files)})


@dataclass(frozen=True)
class Draw:
    """To a writer or drawer."""

    job: int
    stage: str
    """File that is drawn."""
    name: str
    """Of the contact sheet, without its ending."""
    device: str


@dataclass(frozen=True)
class Drawn:
    """From a writer or drawer: a contact sheet is on disk."""

    job: int
    files: dict[str, str]
    """SHA-256 by path below the output folder."""


@dataclass(frozen=True)
class NotMade:
    """From a writer: a sculpture of a batch was given up."""

    job: int
    batch: int
    trouble: Trouble
    why: str


@dataclass(frozen=True)
class NotDrawn:
    """From a writer or drawer: a contact sheet could not be drawn."""

    job: int
    trouble: Trouble
    why: str
