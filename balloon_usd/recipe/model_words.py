"""Which words of a recipe belong to which physical model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.language.problem import Complaint
from balloon_usd.operations.aim import Aim
from balloon_usd.operations.braid import Braid
from balloon_usd.operations.curl import Curl
from balloon_usd.operations.cut import Cut
from balloon_usd.operations.entries import steps_in
from balloon_usd.operations.inflate import Inflate
from balloon_usd.operations.insert import Insert
from balloon_usd.operations.marriage import Marriage
from balloon_usd.operations.pop import Pop
from balloon_usd.operations.push import Push
from balloon_usd.operations.roll import Roll
from balloon_usd.operations.spiral import Spiral
from balloon_usd.operations.split import Split
from balloon_usd.operations.squeeze import Squeeze
from balloon_usd.operations.tail_ball import TailBall
from balloon_usd.operations.thread import Thread
from balloon_usd.operations.tie import Tie
from balloon_usd.operations.tuck import Tuck
from balloon_usd.operations.tulip import Tulip
from balloon_usd.operations.tulip_link import TulipLink
from balloon_usd.operations.wrap import Wrap

from .balloons import balloons_in, rounds_in

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .models import ModelName

LATEX_ONLY = {
    "softening": "springs do not soften",
    "friction": "rubber slides freely on rubber",
    "burst": "springs do not burst",
    "leak": "its air is fetched back where it leaks",
    "mass_scaling": "everything has unit mass",
}
"""Keys of the physics that the model kosaka does not know, and why."""

LATEX_STEPS = {
    Curl.word: (", whose balloons do not roll up", "bend"),
    Aim.word: (", whose joints are frozen", "no such step"),
    Inflate.word: (", whose balloons start blown up", "no such step"),
    Insert.word: (", whose balloons start blown up", "no such step"),
    Squeeze.word: (", whose fingers are forces on patches of a wall", "press, or no such step"),
    Push.word: (", whose walls hardly rub", "no such step"),
    Roll.word: (", whose walls hardly rub", "no such step"),
    Tuck.word: (", whose walls hardly rub", "no such step"),
    Thread.word: (", whose walls hardly rub", "no such step"),
    Marriage.word: (", whose walls hardly rub", "weave"),
    Wrap.word: (", whose walls hardly rub", "no such step"),
    Braid.word: (", whose walls hardly rub", "no such step"),
    Spiral.word: (", whose walls hardly rub", "no such step"),
    Pop.word: (", whose air particles stay in", "no such step"),
    Cut.word: (", whose air particles stay in", "no such step"),
    Split.word: (", whose air particles find no way into both halves", "ear"),
    Tulip.word: (", whose net is not turned inside out", "no such step"),
    TulipLink.word: (", whose net is not turned inside out", "lock: {joints: [...]}"),
    Tie.word: (", whose balloons have neither nozzle nor flat tip", "lock: {joints: [...]}"),
    TailBall.word: (", whose springs do not soften", "no such step"),
    "burp": (", whose bubbles keep the air particles that are in them", "no burp"),
    "turns": (": its joints freeze and are not wound", "no turns"),
}
"""Keys of steps that it does not know, why, and what to write instead."""

_MODEL: ModelName = "latex"
"""The model of a recipe that names none."""


def model_complaints(data: object) -> Iterator[Complaint]:
    """Yield what does not belong to the model of a recipe, given as plain data of whatever shape it is."""
    physics = _physics_in(data)
    model = physics.get("model", _MODEL)
    if model == "kosaka":
        for key in physics:
            if key in LATEX_ONLY:
                what = f"makes no sense with model kosaka: {LATEX_ONLY[key]}, expected no such line"
                yield Complaint(("physics", key), what)
        if isinstance(data, dict) and "tempo" in data:
            what = "makes no sense with model kosaka: its hands go as slowly as air particles follow"
            yield Complaint(("tempo",), f"{what}, expected no such line")
        yield from _kosaka_steps(data)
        for balloon in rounds_in(data):
            what = "makes no sense with model kosaka, whose balloons are tubes and capsules"
            yield Complaint(("balloons", balloon, "size"), f"{what}, expected model: latex")
    elif model == "latex":
        if "kosaka" in physics:
            what = "stands beside model latex, which has no such constants, expected model: kosaka"
            yield Complaint(("physics", "kosaka"), what)
        for balloon, entry in balloons_in(data).items():
            if isinstance(entry, dict) and "capsule" in entry and balloon not in rounds_in(data):
                what = "a closed capsule has no knot to blow up from in model latex"
                expected = "inflated here, or physics: {model: kosaka}"
                yield Complaint(("balloons", balloon, "capsule"), f"{what}, expected {expected}")


def _kosaka_steps(data: object) -> Iterator[Complaint]:
    for step in steps_in(data):
        for key, (why, expected) in LATEX_STEPS.items():
            if key in step.entries:
                what = f"makes no sense with model kosaka{why}, expected {expected}"
                yield Complaint((*step.path, key), what)


def _physics_in(data: object) -> dict[str, Any]:
    physics = data.get("physics") if isinstance(data, dict) else None
    return physics if isinstance(physics, dict) else {}
