"""`weave`: a row of bubbles, each twisted to a joint of others as soon as it is made."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from pydantic import Field

from balloon_usd.language.joint import Joint, JointEntry, readable_joints
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.operation import Lengths
from balloon_usd.operations.weaving import WeavesRow

if TYPE_CHECKING:
    from balloon_usd.operations.workbench import Place, Workbench


class WovenRow(Entries):
    """What is woven to what."""

    bubbles: Lengths
    """Bubbles of the row, in order."""
    to: tuple[JointEntry, ...] = Field(min_length=1)
    """A joint of others for the end of each; with one more, the first is for the start of the row."""


class Weave(WeavesRow):
    """Twist a row of bubbles off, and each, as soon as it is made, to a joint of others."""

    word: ClassVar[str] = "weave"
    called: ClassVar[tuple[str, ...]] = ("ladder", "net")
    value_model: ClassVar[type[Entries] | None] = WovenRow
    example: ClassVar[str] = """\
format: 1
name: frill
units: cm
balloons:
  band: {size: 260, color: red, length: 16, tail: 7}
  main: {size: 260, color: white, length: 24, tail: 7}
steps:
  - bubbles: {band_1: 6, band_2: 6, band_3: 6, band_4: 6}
    balloon: band
  - weave:
      bubbles: {frill_1: 12, frill_2: 12, frill_3: 12, frill_4: 12}
      to: [band_1.start, band_1.end, band_2.end, band_3.end, band_4.end]
    balloon: main
"""
    sources: ClassVar[tuple[str, ...]] = (
        "bpmizuki.hatenablog.jp: はしご編み, the ladder weave",
        "balloonotherapy.blogspot.com 2015-02: a vase, row on row",
        "balloonhq.com: weaving, rows on spokes",
    )

    weave: WovenRow
    """Twist bubbles off, and each, as soon as it is made, to a joint of others."""

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Joints of others for the end of each; with one more, the first is for the start of the row."""
        return self.weave.to

    @classmethod
    def joints_in(cls, value: object) -> tuple[Joint, ...]:
        """Return the joints that a value names, as far as they can be read."""
        return readable_joints(value.get("to")) if isinstance(value, dict) else ()

    @classmethod
    def fits(cls, value: object, place: Place, bench: Workbench) -> bool:
        """Say whether there are joints enough for its bubbles, and complain if there are not."""
        names, joints = cls.makes(value), cls.joints_in(value)
        # What is no joint is told where it stands.
        if not isinstance(value, dict) or len(joints) < len(value["to"]):
            return False
        if len(joints) in (len(names), len(names) + 1):
            return True
        counts = f"{len(joints)} joints for {len(names)} bubbles"
        bench.complain(
            (*place.path, cls.word, "to"), f"{counts}, expected as many, or one more for the start"
        )
        return False
