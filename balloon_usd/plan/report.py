"""The plan as text for people and as data for programs."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.pressures import kilopascals
from balloon_usd.operations.moves import LeadIn
from balloon_usd.operations.parting import parts_of
from balloon_usd.operations.workpiece import Contact, Joined, Popped
from balloon_usd.plan.budget import amount
from balloon_usd.plan.holding import friction_margin
from balloon_usd.plan.lungs import blown_by, opening_pressure
from balloon_usd.plan.overblowing import load_of
from balloon_usd.plan.parking import parked
from balloon_usd.plan.pumping import pumped

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Mapping, Sequence

    from balloon_usd.operations.caution import Caution
    from balloon_usd.operations.operation import Operation
    from balloon_usd.plan.budget import Budget
    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.model import Plan
    from balloon_usd.plan.shaped import Shaped
    from balloon_usd.plan.strip import BlownRound, PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

ROUND_OFF = 5.0e-5
"""Length that is not shown, m."""
PLAN_FORMAT = 1
"""Version of the layout of `plan_json`."""


def plan_text(plan: Plan) -> str:
    """Return the plan as readable text: strips, tail, joints, locks and cautions with their reasons."""
    lasts = f"{round(plan.choreography.seconds)} s: {plan.frame_count} frames"
    shown = f"the animation lasts {lasts}, {plan.recipe.fps:g} a second"
    lines, popped = [*head_lines(plan), shown], plan.recipe.piece.popped
    for name, strip in plan.strips.items():
        if strip.shape is not None:
            lines += ["", *_shape_lines(strip, strip.shape), *_stroke_lines(plan, name)]
        elif strip.capsule:
            lines += ["", *_capsule_lines(strip)]
        elif strip.blown is not None:
            lines += ["", *_round_lines(strip, strip.blown, popped), *_stroke_lines(plan, name)]
        else:
            lines += ["", *_strip_lines(strip, popped), *_budget_lines(plan, plan.budgets[name])]
            lines += _stroke_lines(plan, name)
    graph = [] if plan.of_meshes else ["", *_graph_lines(plan)]
    lines += [*graph, "", *caution_lines(plan.cautions)]
    return "\n".join(lines) + "\n"


def head_lines(plan: Plan) -> Iterator[str]:
    """Yield what a plan is of."""
    recipe = plan.recipe
    yield f"{recipe.title} ({recipe.name})" if recipe.title else recipe.name
    if recipe.source:
        yield f"after {recipe.source}"
    yield f"model {recipe.physics.model}: {recipe.physics.traits.title}"
    if recipe.mirror:
        yield "mirrored: what points left comes out right"


def _strip_lines(strip: Strip, popped: Container[str]) -> Iterator[str]:
    size = strip.size
    yield f"balloon {strip.balloon}: {size.name}, {cm(size.length)} flat{_place(strip)}"
    yield from bubble_lines(strip, strip.bubbles, popped)


def bubble_lines(strip: Strip, bubbles: Sequence[PlannedBubble], popped: Container[str]) -> Iterator[str]:
    """Yield a table of bubbles of a strip, with the gas of those that are not popped."""
    width = max(len("bubble"), *(len(bubble.name) for bubble in strip.bubbles))
    yield f"  {'bubble':{width}}  kind    length    from      to   of flat tube     gas"
    for bubble in bubbles:
        gas = "  popped" if bubble.name in popped else f"{bubble.volume * 1e6:5.0f} mL"
        yield (
            f"  {bubble.name:{width}}  {bubble.kind:6}"
            f"{bubble.length * 100:5.1f} cm  {bubble.start * 100:6.1f}  {bubble.end * 100:6.1f}   "
            f"{bubble.rest_start * 100:5.1f} to {bubble.rest_end * 100:4.1f}  {gas}"
        )


def _capsule_lines(strip: Strip) -> Iterator[str]:
    width = max(len("bubble"), *(len(bubble.name) for bubble in strip.bubbles))
    length, wide = strip.capsule_length, 2.0 * strip.inflated_radius
    volume = sum(bubble.volume for bubble in strip.bubbles)
    yield f"balloon {strip.balloon}: capsule of a {strip.size.name}, {cm(length)} long, {cm(wide)} wide"
    yield f"  {'bubble':{width}}  kind    length    from      to     of capsule     air"
    for bubble in strip.bubbles:
        yield (
            f"  {bubble.name:{width}}  {bubble.kind:6}"
            f"{bubble.length * 100:5.1f} cm  {bubble.start * 100:6.1f}  {bubble.end * 100:6.1f}  "
            f"{bubble.rest_start * 100:5.1f} to {bubble.rest_end * 100:5.1f}  {bubble.volume * 1e6:4.0f} mL"
        )
    yield f"  starts blown up: {volume * 1e3:.2f} L"
    if len(strip.bubbles) > 1:
        end = strip.bubbles[-1].end
        yield f"  its necks take {cm(length - end)}: twisted it is {cm(end)} long"


def _round_lines(strip: Strip, blown: BlownRound, popped: Container[str]) -> Iterator[str]:
    size = strip.size
    form = "heart" if size.heart else "round"
    yield f"balloon {strip.balloon}: {size.name}, {form}, {cm(2.0 * size.radius)} wide flat{_place(strip)}"
    yield from bubble_lines(strip, strip.bubbles, popped)
    if blown.before is not None:
        load = "" if size.heart else f", {load_of(strip.rubber, size, blown.before.width):.0%} of burst"
        yield f"  blow up until it is {cm(blown.before.width)} wide: {_gas(blown.before)}{load}"
        yield f"  let air out until it is {cm(blown.width)} wide: {_gas(blown)}"
    else:
        yield f"  blow up until it is {cm(blown.width)} wide: {_gas(blown)}"


def _gas(blown: BlownRound) -> str:
    pressure, volume = blown.pressure, blown.volume
    return f"{volume * 1e3:.2f} L at {kilopascals(pressure)}, {amount(pressure, volume):.3f} mol"


def _place(strip: Strip) -> str:
    return "" if strip.inside is None else f", lies in {strip.inside}"


def _shape_lines(strip: Strip, shape: Shaped) -> Iterator[str]:
    x, y, z = (f"{100.0 * side:.1f}" for side in shape.surface.size)
    ball = cm(2.0 * shape.swell * shape.surface.ball_radius)
    mesh = f"mesh of {len(shape.surface.quads)} quads"
    yield f"balloon {strip.balloon}: {mesh}, {x} x {y} x {z} cm flat{_place(strip)}"
    yield f"  {1e4 * shape.surface.area:.0f} cm2 of wall, {1e3 * strip.size.thickness:g} mm thick"
    yield (
        f"  blow up to {shape.volume * 1e3:.2f} L in {shape.seconds:.1f} s (swell {shape.swell:g}): "
        f"a ball would be {ball} wide, at {kilopascals(shape.pressure)}"
    )


def _budget_lines(plan: Plan, budget: Budget) -> Iterator[str]:
    twists = len(budget.twists)
    gas = f"{budget.volume * 1e3:.2f} L"
    if plan.recipe.physics.traits.winds:
        gas += f" at {kilopascals(budget.pressure)}, {budget.gas_amount:.3f} mol"
    yield f"  blow up {cm(budget.inflated_length)}, leave {cm(budget.tail)} flat: {gas}"
    if plan.recipe.physics.traits.winds:
        yield _opening_line(plan.strips[budget.balloon])
    each = f"about {cm((budget.tail_needed - budget.drawn) / max(twists, 1))} each"
    if budget.drawn > 0.0:
        each += f", and {cm(budget.drawn)} that turns draw in"
    counted = "1 twist" if twists == 1 else f"{twists} twists"
    if budget.runs_out and budget.tail_used < budget.tail_needed - ROUND_OFF:
        needs = "needs" if twists == 1 else "need"
        short = f"({each}), and there are {cm(budget.tail_used)}"
        yield f"  {counted} {needs} {cm(budget.tail_needed)} of flat tail {short}"
    else:
        uses = "uses" if twists == 1 else "use"
        left = f"({each}), {cm(budget.tail_left)} are left"
        yield f"  {counted} {uses} {cm(budget.tail_used)} of flat tail {left}"
    if budget.most_tail > budget.tail_needed:
        yield (
            f"  fits when blown up {at_least(budget.shortest_inflation)} "
            f"to {at_most(budget.longest_inflation)} "
            f"(tail {at_most(budget.most_tail)} to {at_least(budget.tail_needed)})"
        )


def _opening_line(strip: Strip) -> str:
    """Tell at which pressure a tube begins to grow, as it comes and where its start is stretched."""
    first, stretched = (f"{kilopascals(pressure)} ({blown_by(pressure)})" for pressure in _opening(strip))
    if stretched == first:
        return f"  it begins to grow at {first}"
    return f"  it begins to grow at {first}, and at {stretched} where hands stretched its start before"


def _opening(strip: Strip) -> tuple[float, float]:
    """Return the gauge pressures of `_opening_line`, Pa."""
    size, rubber = strip.size, strip.rubber
    return opening_pressure(size, rubber, stretched=False), opening_pressure(size, rubber, stretched=True)


def _stroke_lines(plan: Plan, balloon: str) -> Iterator[str]:
    if (pumping := pumped(plan, balloon)) is not None:
        each = f"{pumping.air * 1e6:.0f} mL of air"
        yield f"  {_count(pumping.strokes, 'stroke')} of a pump, {each} each"


def _graph_lines(plan: Plan) -> Iterator[str]:
    graph = plan.graph
    strokes = "one balloon" if graph.one_stroke else f"{graph.fewest_balloons} balloons"
    # No other balloon makes what a round one is.
    rounds = any(strip.is_round for strip in plan.strips.values())
    yield ring_line(graph) if rounds else f"{ring_line(graph)}; {strokes} could make it"
    led_in = _led_in(plan)
    firm = plan.piece_let_go.holding()
    for event in plan.recipe.piece.history:
        if isinstance(event, Contact):
            yield f"  step {event.step + 1} {event.text}" + f", {event.which_hold}" * (event in firm)
        if isinstance(event, Popped):
            does = f"{plan.recipe.steps[event.step].does} {event.bubble}"
            yield f"  step {event.step + 1} {does}{_apart(plan, event)}"
        if isinstance(event, Joined):
            for balloon in [name for name, step in led_in if step == event.step]:
                led_in.remove((balloon, event.step))
                side = "right" if _aside(plan)[balloon] > 0.0 else "left"
                yield f"  step {event.step + 1} leads in {balloon} from the {side}"
        if isinstance(event, Joined) and _is_told(plan.recipe.steps[event.step], event):
            what = f"{plan.recipe.steps[event.step].does} {', '.join(map(str, event.ends))}"
            yield f"  step {event.step + 1} {what} (joint {graph.joint_of(event.ends[0]).index})"
    yield from joint_lines(graph, margins_of(plan.recipe, graph))


def _is_told(step: Operation, event: Joined) -> bool:
    """Tell if joining ends is more than what a step does with each bubble that it makes."""
    return not step.closes or any(end.bubble not in step.lengths for end in event.ends)


def _apart(plan: Plan, event: Popped) -> str:
    """Tell if a figure comes apart when a bubble is popped."""
    before, after = (len(parts_of(plan.recipe.piece.after(step))) for step in (event.step - 1, event.step))
    return ", and so the figure comes apart" if after > before else ""


def margins_of(recipe: Recipe, graph: SculptureGraph, step: int | None = None) -> dict[int, float]:
    """Return how many times the friction that they need joints have that hold by it, by their indices.

    `step`: index of the last step that is done, after which the graph is; None for all.
    """
    found = ((joint.index, friction_margin(recipe, joint.ends, step)) for joint in graph.joints)
    return {index: margin for index, margin in found if margin is not None}


def _aside(plan: Plan) -> dict[str, float]:
    """Return how far to the side (+y) frames show each balloon until it is joined, by its name, m."""
    places = parked(plan.strips)
    return {name: 0.0 - place for name, place in places.items()} if plan.mirrored else places


def _led_in(plan: Plan) -> list[tuple[str, int]]:
    """Return which balloons are led in to others, and at which steps: one to which others were led may be
    led on with them.
    """
    rings = plan.table.rings
    moves = (move for move in plan.choreography.moves if isinstance(move, LeadIn))
    return [(rings[move.ring].balloon, move.step) for move in moves]


def ring_line(graph: SculptureGraph) -> str:
    """Return how much of what a graph has."""
    bubbles, rings = _count(len(graph.edges), "bubble"), _count(graph.rings, "closed ring")
    return f"{_count(len(graph.joints), 'joint')}, {bubbles}, {rings}"


def joint_lines(graph: SculptureGraph, margins: Mapping[int, float]) -> Iterator[str]:
    """Yield a line for every joint of a graph; `margins`: how many times the friction that they need some
    joints have, by their indices.
    """
    for place in graph.joints:
        margin = margins.get(place.index)
        held = "" if margin is None else f" (held by {margin:.1f} times the friction that it needs)"
        yield f"  joint {place.index}, {_count(graph.degree(place.index), 'bubble end')}: {place}{held}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def caution_lines(cautions: tuple[Caution, ...]) -> Iterator[str]:
    """Yield cautions with their reasons and remedies."""
    if not cautions:
        yield "no cautions"
        return
    yield _count(len(cautions), "caution")
    for caution in cautions:
        place = "" if caution.step is None else f"step {caution.step + 1}: "
        yield f"  {place}{caution.what}"
        yield f"    because {caution.why}"
        yield f"    remedy: {caution.remedy}"


def plan_json(plan: Plan) -> dict[str, Any]:
    """Return the plan as plain data, ready for JSON: SI units, step indices from 0."""
    aside, led_in = _aside(plan), dict(reversed(_led_in(plan)))
    return {
        **head_json(plan),
        "balloons": [
            {
                **_balloon_json(strip, plan.budgets.get(name)),
                "aside": aside.get(name, 0.0),
                "led_in": led_in.get(name),
                "pumping": None if (pumping := pumped(plan, name)) is None else pumping._asdict(),
            }
            for name, strip in plan.strips.items()
        ],
        "graph": graph_json(
            plan.graph, margins_of(plan.recipe, plan.graph), winds=plan.recipe.physics.traits.winds
        ),
        "cautions": [asdict(caution) for caution in plan.cautions],
        "notices": [asdict(notice) for notice in plan.recipe.notices],
    }


def head_json(plan: Plan) -> dict[str, Any]:
    """Return what a plan is of, as plain data."""
    return {
        "format": PLAN_FORMAT,
        "name": plan.recipe.name,
        "title": plan.recipe.title,
        "recipe_sha256": plan.recipe.sha256,
        "model": plan.recipe.physics.model,
    }


def graph_json(graph: SculptureGraph, margins: Mapping[int, float], *, winds: bool) -> dict[str, Any]:
    """Return a graph as plain data; joints of frozen springs never spring back.

    `margins`: how many times the friction that they need some joints have, by their indices.
    """
    return {
        "joints": [
            {
                "index": joint.index,
                "ends": [str(end) for end in joint.ends],
                "degree": graph.degree(joint.index),
                "merged": joint.merged,
                "springs_back": winds and graph.springs_back(joint.index),
                "margin": margins.get(joint.index),
            }
            for joint in graph.joints
        ],
        "edges": [asdict(edge) for edge in graph.edges],
        "contacts": [asdict(contact) for contact in graph.contacts],
        "rings": graph.rings,
        "pieces": len(graph.pieces),
        "odd_joints": list(graph.odd_joints),
        "fewest_balloons": graph.fewest_balloons,
    }


def _balloon_json(strip: Strip, budget: Budget | None) -> dict[str, Any]:
    """Data of one balloon; only tubes have a budget, and only meshes a shape."""
    return {
        "name": strip.balloon,
        "size": asdict(strip.size),
        "rubber": strip.rubber.name,
        "softening": strip.rubber.softening is not None,
        "capsule": strip.capsule,
        "tail": strip.tail,
        "inflated_length": _inflated_length(strip) if budget is None else budget.inflated_length,
        "width": strip.width,
        "overblown": None if strip.blown is None else _overblown_json(strip, strip.blown.before),
        "inside": strip.inside,
        "shape": None if strip.shape is None else _shape_json(strip.shape),
        "bubbles": [asdict(bubble) | {"drawn": list(bubble.drawn)} for bubble in strip.bubbles],
        "budget": None if budget is None else _budget_json(strip, budget),
    }


def _inflated_length(strip: Strip) -> float:
    return strip.capsule_length if strip.blown is None else strip.blown.height


def _overblown_json(strip: Strip, before: BlownRound | None) -> dict[str, Any] | None:
    """Data of what a round balloon is blown up to before air is let out."""
    if before is None:
        return None
    load = None if strip.size.heart else load_of(strip.rubber, strip.size, before.width)
    keys = ("width", "height", "volume", "pressure")
    return {key: getattr(before, key) for key in keys} | {"load": load}


def _shape_json(shape: Shaped) -> dict[str, Any]:
    return {
        "file_sha256": shape.file_sha256,
        "quads": len(shape.surface.quads),
        "size": list(shape.surface.size),
        "area": shape.surface.area,
        "swell": shape.swell,
        "volume": shape.volume,
        "seconds": shape.seconds,
    }


def _budget_json(strip: Strip, budget: Budget) -> dict[str, Any]:
    first, stretched = _opening(strip)
    return {
        "tail_needed": budget.tail_needed,
        "tail_used": budget.tail_used,
        "tail_left": budget.tail_left,
        "most_tail": budget.most_tail,
        "cost_per_twist": budget.cost_per_twist,
        "drawn": budget.drawn,
        "shortest_inflation": budget.shortest_inflation,
        "longest_inflation": budget.longest_inflation,
        "volume": budget.volume,
        "pressure": budget.pressure,
        "gas_amount": budget.gas_amount,
        "opening_pressure": first,
        "opening_pressure_stretched": stretched,
        "twists": [asdict(twist) for twist in budget.twists],
    }
