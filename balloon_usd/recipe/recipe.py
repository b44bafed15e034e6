"""The recipe: what is read from a file, checked, and handed to the plan."""

import hashlib
from dataclasses import dataclass, field
from typing import Annotated, Literal, Self

from pydantic import (
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    PrivateAttr,
    StrictBool,
    Tag,
    ValidationError,
    ValidationInfo,
    model_validator,
)

from balloon_usd.language.joint import JointEntry
from balloon_usd.language.marks import Marks
from balloon_usd.language.names import Name, Text
from balloon_usd.language.problem import Complaint, Notice, Path, Problem, RecipeError, path_text, quoted
from balloon_usd.language.quantities import METRES, Between, LengthWithin, Reading, Units
from balloon_usd.language.yaml_reader import Document, read_yaml
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.moves import LET_GO, Pose
from balloon_usd.operations.table import Step
from balloon_usd.operations.tempo import Tempo
from balloon_usd.operations.workpiece import Workpiece

from .balloons import Balloon
from .facing import FacingEntry
from .meaning import meaning_of
from .physics import Physics
from .recipe_file import FilePath, read_recipe_file
from .repeats import written_out
from .translation import validation_complaints
from .upgrades import upgraded
from .writer import recipe_entries, recipe_text

ALL, SOME = "all, planned or none of them", "a list of joints"
"""Tags of the forms of `must_hold`, which never occur as keys of a recipe."""


def _held(value: object) -> str | None:
    if isinstance(value, (list, tuple)):
        return SOME
    return ALL if isinstance(value, str) else None


Held = Annotated[
    Annotated[Literal["all", "planned", "none"], Tag(ALL)]
    | Annotated[Annotated[tuple[JointEntry, ...], Field(min_length=1)], Tag(SOME)],
    Discriminator(_held),
]
FRAMES_PER_SECOND = 24.0
HIGHEST = 10.0
"""Farthest above the ground that a figure can be let go, m."""
EARTH = 9.81
"""Gravity of figures that stand, fall or are thrown, m/s2."""


@dataclass(frozen=True)
class _Origin:
    """The text a recipe was read from."""

    marks: Marks = field(default_factory=lambda: Marks("<python>"))
    text: str | None = None
    notices: tuple[Notice, ...] = ()


def _format(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int):  # true and 1.0 equal 1
        raise ValueError(f"{quoted(value)} is no format, expected 1")
    return value


class Recipe(Entries):
    """A recipe of balloon twists (format 1), complete and consistent."""

    model_config = ConfigDict(title="Balloon recipe")

    format: Annotated[Literal[1], BeforeValidator(_format)]
    """Version of the recipe language."""
    name: Name
    """Identifier: names the file and the prim."""
    title: Text = ""
    """Name of the figure for people."""
    source: Text = ""
    """Where the recipe comes from."""
    units: Units | None = None
    """Unit of lengths written as bare numbers."""
    fps: Annotated[float, Between(1.0, 240.0, "frames/s")] = FRAMES_PER_SECOND
    """Frames in a second."""
    tempo: Tempo = "calm"
    """How fast hands twist and lead; `seconds` of a step rule for that step."""
    balloons: Annotated[dict[Name, Balloon], Field(min_length=1)]
    """Balloons by name."""
    steps: Annotated[tuple[Step, ...], Field(min_length=1)]
    """What the hands do, in order."""
    pose: Pose = "as made"
    """How the finished figure is shown: where it was made, or put so that it stands on the ground at the
    origin, hangs from a thread, or is held with its middle at the origin."""
    height: Annotated[float, LengthWithin(high=HIGHEST, low_included=True)] | None = None
    """How far above the ground the lowest point of a figure is that is dropped or thrown, 1 m when absent; m
    in Python."""
    speed: Annotated[float, Between(0.0, 10.0, "m/s")] | None = None
    """How fast it is thrown ahead, 3 m/s when absent."""
    front: FacingEntry = "forward"
    """Which side of the figure, as it is made, is its front, or bubbles there: in the end it faces -x."""
    top: FacingEntry | None = None
    """Which side of the figure, as it is made, is its top, or bubbles there: in the end it is turned up."""
    symmetric: StrictBool = True
    """Whether hands set the finished figure straight, so that bubbles left_... and right_... of which it says
    the same are mirror images of each other."""
    mirror: StrictBool = False
    """Whether the finished stage is the mirror image of what the recipe says, left and right exchanged."""
    must_hold: Held = "all"
    """Joints of which one that comes undone makes the run fail: all, planned for those that hold as planned,
    none, or some such as [nose.end]."""
    physics: Physics = Physics()
    """How it is simulated."""

    _origin: _Origin = PrivateAttr(default_factory=_Origin)
    _piece: Workpiece = PrivateAttr()

    @classmethod
    def load(cls, path: FilePath) -> Self:
        """Read a recipe file.

        Raises:
            RecipeError: with all problems of the file, also if it cannot be read at all.
        """
        return cls.parse(read_recipe_file(path), file=str(path))

    @classmethod
    def parse(cls, text: str, file: str = "<text>") -> Self:
        """Read a recipe from YAML text; `file` is how messages call it. See `notices` for older words in it.

        Raises:
            RecipeError: with all problems of the text.
        """
        document, notices = upgraded(written_out(read_yaml(text, file)))
        complaints = list(document.complaints)
        try:
            recipe = cls.model_validate(document.data, context=Reading(_units_in(document.data)))
        except ValidationError as error:
            recipe = None
            complaints += validation_complaints(error, document.data, cls)
        meaning = meaning_of(document.data)
        complaints += meaning.complaints
        if recipe is None or complaints:
            raise RecipeError(document.marks.problems(_without_echoes(complaints, document)))
        recipe._origin, recipe._piece = _Origin(document.marks, text, notices), meaning.piece
        return recipe

    @model_validator(mode="after")
    def _check_meaning(self, info: ValidationInfo) -> Self:
        if not isinstance(info.context, Reading):  # parse() reports meaning with places
            complaints, piece = meaning_of(self._entries())
            if complaints:
                texts = [f"{path_text(complaint.path)}: {complaint.text}" for complaint in complaints]
                raise ValueError("; ".join(texts))
            self._piece = piece
        return self

    @property
    def piece(self) -> Workpiece:
        """What the steps make of the balloons, one after the other."""
        return self._piece

    @property
    def lands(self) -> bool:
        """Whether the finished figure stands or falls on the ground."""
        return self.pose in ("stand", *LET_GO)

    @property
    def gravity(self) -> float:
        """Gravity that acts on the finished figure, m/s2: that of the earth where its pose is one on the
        ground, and none where hands or a thread hold it, if the recipe does not say.
        """
        given = self.physics.gravity
        if given is None:
            return EARTH if self.physics.traits.has_weight and self.lands else 0.0
        return given

    @property
    def file(self) -> str:
        """Name of the file it was read from."""
        return self._origin.marks.file

    @property
    def notices(self) -> tuple[Notice, ...]:
        """What its writer should know though nothing is wrong, such as words that have new names."""
        return self._origin.notices

    @property
    def sha256(self) -> str:
        """Hash of the text, hexadecimal."""
        text = self.to_yaml() if self._origin.text is None else self._origin.text
        return hashlib.sha256(text.encode("utf-8")).hexdigest()

    def problem(self, path: Path, text: str) -> Problem:
        """Make a problem found later, such as in the plan, at its place in this file."""
        return self._origin.marks.problem(path, text)

    def to_yaml(self) -> str:
        """Write the recipe as YAML text that reads back as an equal recipe."""
        return recipe_text(self._entries())

    def _entries(self) -> dict[str, object]:
        written = self.model_dump(exclude_defaults=True)
        return recipe_entries(written, self.balloons, self.steps, self.units)

    def __eq__(self, other: object) -> bool:
        """Compare what the recipes say, not where they were written."""
        if not isinstance(other, Recipe):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in Recipe.model_fields)

    __hash__ = None  # type: ignore[assignment]


def _units_in(data: object) -> str | None:
    """Units to read bare numbers with; a wrong name is reported once, not at every number."""
    units = data.get("units") if isinstance(data, dict) else None
    if units is None:
        return None
    return units if isinstance(units, str) and units in METRES else "cm"


def _without_echoes(complaints: list[Complaint], document: Document) -> list[Complaint]:
    """Drop complaints about what the reader has already refused."""
    refused = [complaint.path for complaint in document.complaints]
    later = complaints[len(refused) :]
    prefixes = set(refused)
    return complaints[: len(refused)] + [
        complaint
        for complaint in later
        if not any(complaint.path[:end] in prefixes for end in range(1, len(complaint.path) + 1))
    ]
