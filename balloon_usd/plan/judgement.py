"""The judgement: what a maker would warn of before taking the balloon in hand."""

from __future__ import annotations

import math
from itertools import chain
from typing import TYPE_CHECKING

from balloon_usd.balloon.bubble_shape import smallest_ball, softest_ball
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.wound_neck import PACKING_TURNS, holding_friction
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.pressures import kilopascals
from balloon_usd.language.turns import turns_text
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.modifiers import HOLDING_TURNS, Turned
from balloon_usd.operations.workpiece import Joined
from balloon_usd.plan.bent_chains import bends_onto_others
from balloon_usd.plan.filling import emptier
from balloon_usd.plan.hard_lobes import hard_lobes
from balloon_usd.plan.holding import too_slippery
from balloon_usd.plan.long_sides import long_sides
from balloon_usd.plan.open_tube import MILLIMETRE, roomy_share, shortened, softened, tail_range
from balloon_usd.plan.overblowing import bursting_width, load_of
from balloon_usd.plan.released import divided, leaking, released
from balloon_usd.plan.room import room_cautions
from balloon_usd.plan.wall_load import wall_loads
from balloon_usd.recipe.held_words import EVERY, MUST_HOLD, PLANNED

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.operations.layout import Layout
    from balloon_usd.plan.budget import Budget
    from balloon_usd.plan.graph import GraphJoint, SculptureGraph
    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

MOST_TURNS = 5.0
"""Turns above which a twist eats tail and can cut the rubber: makers stop at 5."""
DRAWS = f"every turn beyond {PACKING_TURNS:g} draws rubber into it, and too many cut it"
"""Why too many turns strain the neck of a tube."""
SURELY_BORNE = 0.93
"""Load of a wall up to which it surely bears it: plans and runs agree to some per cent near bursting."""
EVEN = 2.4
"""Growth of volume up to which a long shape stays even: measured on a ring of round cross-section."""
LONGER = 1.4
"""Length of a flat tube, in that of its size, from which on none is sold: brands differ by a third."""
LONG = (0.1, 0.68)
"""Volumes of a shape, in that of a ball of its wall, between which it is long: no ball, no flat sheets."""


def cautions_of(
    recipe: Recipe,
    strips: Mapping[str, Strip],
    layout: Layout,
    graph: SculptureGraph,
    budgets: Mapping[str, Budget],
) -> tuple[Caution, ...]:
    """Return all cautions, those of the whole sculpture last."""
    found = chain(
        chain.from_iterable(step.cautions(index, layout) for index, step in enumerate(recipe.steps)),
        chain.from_iterable(
            step.beyond_reach(index, layout, recipe.piece) for index, step in enumerate(recipe.steps)
        ),
        chain.from_iterable(_tail(recipe, strips[name], budget) for name, budget in budgets.items()),
        _of_latex(recipe, strips, graph, budgets) if recipe.physics.traits.winds else (),
        room_cautions(recipe, strips),
        long_sides(strips, graph),
        bends_onto_others(recipe, strips, graph),
        released(recipe.piece),
        divided(recipe.piece),
        leaking(recipe),
        _loose_pieces(recipe, strips),
        _long(recipe, strips),
        _bulging(strips),
    )
    return tuple(
        sorted(found, key=lambda caution: len(recipe.steps) if caution.step is None else caution.step)
    )


def _of_latex(
    recipe: Recipe, strips: Mapping[str, Strip], graph: SculptureGraph, budgets: Mapping[str, Budget]
) -> Iterator[Caution]:
    """What springs with frozen joints do not know: they neither harden, soften, burst nor unwind."""
    yield from _turns(recipe, strips)
    yield from _slippery(recipe)
    yield from _short_bubbles(strips)
    yield from chain.from_iterable(map(hard_lobes, strips.values()))
    yield from chain.from_iterable(_burst(recipe, strips[name], it, graph) for name, it in budgets.items())
    yield from chain.from_iterable(map(_overblown, strips.values()))
    yield from _softening(recipe)
    yield from _unwinding(recipe, strips, graph)


def _turns(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Caution]:
    rounds = {bubble.name for strip in strips.values() if strip.is_round for bubble in strip.bubbles}
    for index, step in enumerate(recipe.steps):
        if not isinstance(step, Turned):
            continue
        if step.turns < HOLDING_TURNS:
            yield Caution(
                index,
                f"a twist of {turns_text(step.turns)} may unwind",
                "the friction of the wound neck grows with every turn",
                "turns: 3",
            )
        elif step.turns > MOST_TURNS:
            yield Caution(
                index,
                f"a twist of {turns_text(step.turns)} strains its neck",
                "too many turns cut it" if rounds.intersection(step.lengths) else DRAWS,
                "turns: 3",
            )


def _slippery(recipe: Recipe) -> Iterator[Caution]:
    friction = recipe.physics.friction
    joining = sorted({event.step for event in recipe.piece.history if isinstance(event, Joined)})
    locks = [step for step in map(recipe.steps.__getitem__, joining) if isinstance(step, Turned)]
    slipping = [step for step in locks if step.holds and too_slippery(step, friction)]
    if slipping:
        turns = min(step.turns for step in slipping)
        yield Caution(
            None,
            f"{len(slipping)} of {len(locks)} locks, loops and ears slip when the hands let go",
            f"a wound neck holds by friction, and {turns_text(turns)} need {holding_friction(turns):.2f}, "
            f"not {friction:g}",
            f"physics: friction: {math.ceil(100.0 * holding_friction(turns)) / 100.0:g}",
        )


def _short_bubbles(strips: Mapping[str, Strip]) -> Iterator[Caution]:
    for strip in strips.values():
        if not strip.balls():
            continue
        size, rubber = strip.size, softened(strip.rubber)
        softest, smallest = softest_ball(size, rubber).length, smallest_ball(size, rubber).length
        for bubble in (strip.bubbles[k] for k in strip.balls()):
            named = f"{bubble.name} ({cm(bubble.length)})"
            if bubble.length < smallest:
                yield Caution(
                    bubble.step,
                    f"{named} is too short for a ball",
                    f"below {cm(smallest)} the necks of a {size.name} bubble lie in each other's way",
                    f"make it {at_least(smallest)} or longer",
                )
            elif bubble.length < softest:
                yield Caution(
                    bubble.step,
                    f"{named} will be a hard little ball",
                    f"below {cm(softest)} a {size.name} bubble needs more pressure than the tube has: "
                    f"{kilopascals(bubble.pressure or 0.0)}",
                    f"make it {at_least(softest)} or longer",
                )


def _long(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Caution]:
    """Warn of tubes far longer than any that is sold: the length of a blown-up one was written, mostly."""
    for name, strip in strips.items():
        if strip.shape is not None or strip.capsule or recipe.balloons[name].length is None:
            continue
        usual = size_named(strip.size.name).length
        if strip.size.length > LONGER * usual:
            yield Caution(
                None,
                f"no {strip.size.name} is as long as {name}, {cm(strip.size.length)} flat",
                f"one is {cm(usual)} long as it comes; this one is {cm(strip.full_length)} when it is full",
                f"length: {cm(usual)}, or inflated: if the length of the blown-up balloon is meant",
            )


def _tail(recipe: Recipe, strip: Strip, budget: Budget) -> Iterator[Caution]:
    out = budget.runs_out
    if out is None:
        return
    yield Caution(
        out.step,
        f"{budget.balloon} runs out of tail at the twist that ends {out.bubble}",
        f"{len(budget.twists)} twists fill {cm(budget.tail_needed)} of flat tail, of {cm(budget.tail)} "
        f"left; from there on each makes what is left harder, up to "
        f"{kilopascals(budget.twists[-1].pressure)} from {kilopascals(budget.pressure)}",
        _more_tail(recipe, strip, budget),
    )


def _more_tail(recipe: Recipe, strip: Strip, budget: Budget) -> str:
    """What to do about a balloon whose twists use up its tail, in the words in which it is filled."""
    bubbles = [bubble.twisted for bubble in strip.bubbles[:-1]]
    remedy, needed = "", budget.tail_needed
    if needed + MILLIMETRE > budget.most_tail:
        share = roomy_share(strip.size, strip.rubber, bubbles)
        shorter, bubbles = shortened(bubbles, share)
        needed = tail_range(strip.size, strip.rubber, bubbles).least
        remedy = f"make the bubbles shorter by {at_least(shorter)} in all, and "
    return remedy + emptier(recipe.balloons[strip.balloon], strip.size, strip.rubber, needed)


def _burst(recipe: Recipe, strip: Strip, budget: Budget, graph: SculptureGraph) -> Iterator[Caution]:
    loads = zip(budget.twists, wall_loads(strip, budget, graph), strict=True)
    burst = next(((twist, load) for twist, load in loads if load > SURELY_BORNE), None)
    if burst is None:
        return
    twist, load = burst
    why = "folded bubbles are stretched most outside their bend"
    remedy = "press gas out of the folded bubbles (burp: 20 %), or make them longer, or fewer"
    if twist.tail_left <= 0.0:
        why = f"with no tail left the rubber is stretched {twist.hoop_stretch:.1f} times round, at "
        why += kilopascals(twist.pressure)
        remedy = _more_tail(recipe, strip, budget)
    yield Caution(
        twist.step,
        f"{budget.balloon} may burst at the twist that ends {twist.bubble}",
        f"{why}: {load:.0%} of the load at which latex tears",
        remedy,
    )


def _overblown(strip: Strip) -> Iterator[Caution]:
    before = strip.overblown
    if before is None:
        return
    if strip.rubber.softening is None:
        what, why = (
            f"{strip.balloon} is overblown for nothing",
            "rubber that does not soften is as hard after that",
        )
        yield Caution(None, what, why, "softening: true")
    load = 0.0 if strip.size.heart else load_of(strip.rubber, strip.size, before)
    if load > SURELY_BORNE:
        what = f"{strip.balloon} may burst where it is blown up to {cm(before)}"
        why = f"{load:.0%} of the load at which latex tears"
        surely = bursting_width(strip.rubber, strip.size, SURELY_BORNE)
        yield Caution(None, what, why, f"overblown: {at_most(surely)}")


def _softening(recipe: Recipe) -> Iterator[Caution]:
    if not recipe.physics.softening:
        yield Caution(
            None,
            "bubbles will bleed into their necks",
            "rubber that does not soften has no closed bubble at the pressure of the tube",
            "softening: true",
        )


def _unwinding(recipe: Recipe, strips: Mapping[str, Strip], graph: SculptureGraph) -> Iterator[Caution]:
    fails = ""
    if recipe.must_hold == EVERY:
        fails = f"; a run fails where it comes undone, but with {MUST_HOLD}: {PLANNED}"
    bubbles = {bubble.name: (strip, bubble) for strip in strips.values() for bubble in strip.bubbles}
    for joint in graph.joints:
        if graph.springs_back(joint.index):
            strip, bubble = bubbles[joint.ends[0].bubble]
            ear = "" if strip.is_round else ", or make one of its neighbours an ear"
            yield Caution(
                bubble.step,
                f"the twist between {_neighbours(joint)} will unwind",
                "nothing holds it: what hangs there is free to spin, and no ring closes over it",
                f"lock it to another joint{ear}{fails}",
            )


def _neighbours(joint: GraphJoint) -> str:
    return " and ".join(dict.fromkeys(end.bubble for end in joint.ends))


def _bulging(strips: Mapping[str, Strip]) -> Iterator[Caution]:
    for name, strip in strips.items():
        if strip.shape is None:
            continue
        own, ball = strip.shape.surface.volume, strip.shape.surface.ball_volume
        if LONG[0] < own / ball < LONG[1] and strip.shape.volume > EVEN * own:
            grown = f"{strip.shape.volume / own:.1f}"
            even = math.floor(100.0 * (EVEN * own / ball) ** (1.0 / 3.0)) / 100.0
            yield Caution(
                None,
                f"{name} may bulge at one place",
                f"a long shape of rubber gives way somewhere, and {grown} times its volume is too much",
                f"swell: {even:g}",
            )


def _first_with_gas(recipe: Recipe, strip: Strip) -> PlannedBubble:
    """Return the first bubble of a balloon that is not popped, or its first one."""
    firm = (bubble for bubble in strip.bubbles if bubble.name not in recipe.piece.popped)
    return next(firm, strip.bubbles[0])


def _loose_pieces(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Caution]:
    if any(strip.shape is not None for strip in strips.values()):
        return
    outside = [strip for strip in strips.values() if strip.inside is None]
    begun = [[it for it in outside if it.bubbles[0].name in piece] for piece in recipe.piece.pieces()]
    firsts = [_first_with_gas(recipe, found[0]) for found in begun if found]
    if len(firsts) < 2:
        return
    names = [strip.balloon for strip in outside]
    # Steps know no bubble that none has named.
    unnamed = [bubble for bubble in firsts if bubble.step == len(recipe.steps)]
    rests = [f"{{rest: {bubble.name}, balloon: {bubble.balloon}}}" for bubble in unnamed]
    lock = f"lock: {{joints: [{', '.join(f'{bubble.name}.start' for bubble in firsts)}]}}"
    yield Caution(
        None,
        f"{', '.join(names)} are not all joined: the sculpture has {len(firsts)} pieces",
        "no lock brings their joints together",
        ", then ".join([*rests, lock]),
    )
