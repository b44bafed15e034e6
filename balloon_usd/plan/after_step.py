"""The plan as it stands after a step: what is made by then, what holds, and what is left to work with."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from balloon_usd.language.lengths import cm
from balloon_usd.language.pressures import kilopascals
from balloon_usd.plan.graph import sculpture_graph
from balloon_usd.plan.holding import loose_joints
from balloon_usd.plan.report import (
    bubble_lines,
    caution_lines,
    graph_json,
    head_json,
    head_lines,
    joint_lines,
    margins_of,
    ring_line,
)
from balloon_usd.plan.twisting_rounds import twisted_round

if TYPE_CHECKING:
    from balloon_usd.language.joint import Joint
    from balloon_usd.operations.caution import Caution
    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.model import Plan
    from balloon_usd.plan.strip import PlannedBubble, Strip


@dataclass(frozen=True)
class OpenPart:
    """What is left of a balloon behind its last twist."""

    length: float
    """Inflated length, m."""
    tail: float | None
    """Flat tail, m; 0 where it is used up, and of a capsule, which has none; None of a round balloon."""
    pressure: float | None
    """Gauge pressure, Pa; None of a capsule."""


@dataclass(frozen=True)
class AfterStep:
    """What is made of a plan's balloons after a step."""

    plan: Plan
    index: int
    """Of the step."""
    graph: SculptureGraph
    """What is left of a balloon that is begun is its last bubble."""
    loose: tuple[Joint, ...]
    """Joints that would untwist if the hands let go now, each as the end of the bubble before it."""

    @property
    def what(self) -> str:
        """The step in a few words."""
        steps = self.plan.recipe.steps
        return f"after step {self.index + 1} of {len(steps)}, {steps[self.index].label}"

    @property
    def popped(self) -> frozenset[str]:
        """Bubbles that have been burst by now."""
        return self.plan.recipe.piece.after(self.index).popped

    @property
    def cautions(self) -> tuple[Caution, ...]:
        """Cautions about this step and those before it."""
        return tuple(c for c in self.plan.cautions if c.step is not None and c.step <= self.index)

    @property
    def margins(self) -> dict[int, float]:
        """How many times the friction that they need joints have that hold by it, by their indices."""
        return margins_of(self.plan.recipe, self.graph, self.index)

    @property
    def strips(self) -> list[Strip]:
        """Balloons that are begun."""
        begun = {edge.balloon for edge in self.graph.edges}
        return [strip for name, strip in self.plan.strips.items() if name in begun]

    def made(self, strip: Strip) -> tuple[PlannedBubble, ...]:
        """Return the bubbles of a balloon that are made by now."""
        return tuple(bubble for bubble in strip.bubbles if bubble.step <= self.index)

    def left(self, strip: Strip) -> OpenPart | None:
        """Return what is left of a balloon; None of one that has ended."""
        made = self.made(strip)
        if made and made[-1] is strip.bubbles[-1]:
            return None
        if strip.capsule:
            return OpenPart(strip.bubbles[-1].end - (made[-1].end if made else 0.0), 0.0, None)
        if strip.blown is not None:
            heights = tuple(bubble.length for bubble in made)
            if not heights:
                return OpenPart(strip.blown.height, None, strip.blown.pressure)
            lobe = twisted_round(strip.size, strip.rubber, strip.blown, heights)[1].lobe
            return OpenPart(lobe.height, None, lobe.pressure)
        budget = self.plan.budgets[strip.balloon]
        if not made:
            return OpenPart(budget.inflated_length, budget.tail, budget.pressure)
        twist = budget.twists[len(made) - 1]
        return OpenPart(twist.length_left, twist.tail_left, twist.pressure)


def after_step(plan: Plan, index: int) -> AfterStep:
    """Return what is made after the step of an index.

    Raises:
        IndexError: there is no such step.
    """
    if not 0 <= index < len(plan.recipe.steps):
        raise IndexError(f"{plan.recipe.name} has no step {index + 1}")
    loose = (
        tuple(joint.end for joint in loose_joints(plan.recipe, index))
        if plan.recipe.physics.traits.winds
        else ()
    )
    return AfterStep(plan, index, sculpture_graph(plan.recipe.piece.after(index)), loose)


def after_step_text(after: AfterStep) -> str:
    """Return what is made after a step as readable text."""
    graph, popped = after.graph, after.popped
    lines = [*head_lines(after.plan), after.what]
    for strip in after.strips:
        lines += ["", f"balloon {strip.balloon}:", *bubble_lines(strip, after.made(strip), popped)]
        lines.append(_left(after.left(strip)))
    held = f"; held by hand alone: {', '.join(map(str, after.loose))}" if after.loose else ""
    lines += [
        "",
        f"{ring_line(graph)}{held}",
        *joint_lines(graph, after.margins),
        "",
        *caution_lines(after.cautions),
    ]
    return "\n".join(lines) + "\n"


def _left(left: OpenPart | None) -> str:
    if left is None:
        return "  nothing more is made of it"
    if left.pressure is None:
        return f"  left: {cm(left.length)}"
    flat = "" if left.tail is None else f", {cm(left.tail)} flat"
    return f"  left: {cm(left.length)} blown up at {kilopascals(left.pressure)}{flat}"


def after_step_json(after: AfterStep) -> dict[str, Any]:
    """Return what is made after a step as plain data, ready for JSON: SI units, step indices from 0."""
    return {
        **head_json(after.plan),
        "step": after.index,
        "balloons": [
            {
                "name": strip.balloon,
                "bubbles": [asdict(bubble) for bubble in after.made(strip)],
                "left": None if (left := after.left(strip)) is None else asdict(left),
            }
            for strip in after.strips
        ],
        "loose": [str(end) for end in after.loose],
        "graph": graph_json(after.graph, after.margins, winds=after.plan.recipe.physics.traits.winds),
        "cautions": [asdict(caution) for caution in after.cautions],
    }
