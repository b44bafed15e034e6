"""Constants of the thesis's model with which no run can work: what the automatic rule would never choose.

Its explicit steps bear only so much stiffness and damping, its air must feel its neighbours, and its regions
must fit into the balloon. The limits were measured on a capsule with one twist.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.balloon.capsule_mesh import EXPERIMENT_RADIUS
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.particles import experiment_spacing

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.language.problem import Path, Problem
    from balloon_usd.recipe import Recipe

USUAL_RATE = 144.0
"""Time steps in a second that the model chooses."""
SLOWEST, QUICKEST = 100.0, 1500.0
"""Time steps in a second between which the rule's constants hold the balloon's shape."""
STEP_LIMITS = {"ks": (0.3, 2), "kd": (0.25, 1), "calming": (0.2, 1), "drag": (1.0, 1)}
"""Largest constants, in units of a power of the time steps in a second."""
NEVER_ZERO = {
    "alpha": "air that does not repel fills no balloon",
    "beta": "a wall that does not push air back holds none",
    "push": "air that does not push the rubber blows nothing up",
}
CROWD = 4.0
"""Largest reach of the repulsion, in distances of particles: there is room for so many neighbours."""
PACKED = 0.4
"""Smallest distance of particles, in that of the thesis: more of them crowd the faces of the wall."""
REACH = 0.010
"""Reach of the repulsion that the model chooses for the thesis's capsule, m."""
THINNEST_REGION = 0.05
"""Thickness of the region in which air and rubber push each other that air still meets, in radii."""
REGIONS = ("air_offset", "leak_offset", "contact_offset", "gamma")
HEAVIEST = 0.5
"""Largest gravity, m/s2: the model's air has weight, and more of it runs out through the wall."""
MOST_ELONGATION = 10.0
"""Largest elongation that a recipe can give as a limit."""
CHOSEN = "or no such line: the model chooses it"


def kosaka_problems(recipe: Recipe, tubes: Mapping[str, BalloonSize]) -> list[Problem]:
    """Return what is wrong with the constants of a recipe of model kosaka, at its places in the file.

    `tubes`: sizes of its tubes, by balloon.
    """
    found = [*_steps(recipe), *_gravity(recipe), *_stiff(recipe), *_zero(recipe), *_taut(recipe)]
    if radii := _radii(recipe, tubes):
        found += [*_reach(recipe, radii), *_regions(recipe, radii)]
    return found


def _steps(recipe: Recipe) -> Iterator[Problem]:
    given = recipe.physics.substeps
    if given is None:
        return
    rate, fps = given * recipe.fps, recipe.fps
    least, most = math.ceil(SLOWEST / fps), math.floor(QUICKEST / fps)
    if rate < SLOWEST:
        text = f"{rate:g} time steps/s are too few for its springs, expected at least {least}, {CHOSEN}"
        yield recipe.problem(("physics", "substeps"), text)
    if rate > QUICKEST:
        # The recipe's own range begins at 20.
        expected = f"at most {most}, {CHOSEN}" if most >= 20 else "no such line: the model chooses them"
        text = f"{rate:g} time steps/s make springs so stiff that the balloon collapses, expected {expected}"
        yield recipe.problem(("physics", "substeps"), text)


def _gravity(recipe: Recipe) -> Iterator[Problem]:
    gravity = recipe.gravity
    if gravity > HEAVIEST:
        text = (
            f"at {gravity:g} m/s2 the air of model kosaka, which has weight, runs out through its wall, "
            f"expected at most {HEAVIEST:g}{'' if _only_kosaka(recipe) else ', or model: latex'}"
        )
        yield recipe.problem(("physics", "gravity"), text)


def _only_kosaka(recipe: Recipe) -> bool:
    """Whether a recipe has what no other model knows."""
    return "kosaka" in recipe.physics.model_fields_set or any(
        balloon.capsule is not None for balloon in recipe.balloons.values()
    )


def _stiff(recipe: Recipe) -> Iterator[Problem]:
    rate = recipe.fps * recipe.physics.substeps if recipe.physics.substeps else USUAL_RATE
    for key, (share, power) in STEP_LIMITS.items():
        value, most = getattr(recipe.physics.kosaka, key), share * rate**power
        if value is not None and value > most:
            text = (
                f"{value:g} flies apart with {rate:g} time steps/s, expected at most {_down(most)}, {CHOSEN}"
            )
            yield recipe.problem(_place(key), text)


def _zero(recipe: Recipe) -> Iterator[Problem]:
    for key, reason in NEVER_ZERO.items():
        if getattr(recipe.physics.kosaka, key) == 0.0:
            yield recipe.problem(_place(key), f"is 0, and {reason}, expected more than 0, {CHOSEN}")


def _taut(recipe: Recipe) -> Iterator[Problem]:
    """The swollen balloon's own springs must not be longer than their limit."""
    law = recipe.physics.kosaka
    if law.elongation_limit is None:
        return
    natural = 0.5 if law.natural is None else law.natural
    least = (1.0 + law.swell) / natural - 1.0
    if law.elongation_limit < least:
        text = f"{law.elongation_limit:g} is less than the springs of the balloon at rest have"
        enough = math.ceil(100.0 * least) / 100.0
        expected = f"at least {enough:g}, {CHOSEN}" if enough <= MOST_ELONGATION else "no such line"
        yield recipe.problem(_place("elongation_limit"), f"{text}, expected {expected}")


def _reach(recipe: Recipe, radii: Sequence[float]) -> Iterator[Problem]:
    """Air must reach its neighbours, and there is room for so many of them: in every balloon."""
    law = recipe.physics.kosaka
    usual = [experiment_spacing(radius) for radius in radii]
    spacings = usual if law.spacing is None else [law.spacing]
    reaches = [REACH * radius / EXPERIMENT_RADIUS for radius in radii] if law.re is None else [law.re]
    # Told of the balloon in which it is worst.
    tightest, shortest = PACKED * max(usual), min(reaches)
    apart = (
        f"repulsion reaches {1e3 * shortest:.3g} mm and air is {_range([1e3 * s for s in spacings])} mm apart"
    )
    if law.spacing is not None and law.spacing < tightest:
        packed = f"{1e3 * law.spacing:.3g} mm packs more air than there is room for"
        yield _within(recipe, "spacing", packed, tightest, min(math.inf, *reaches))
    elif law.re is not None and not max(spacings) < law.re <= CROWD * min(spacings):
        yield _within(recipe, "re", apart, max(spacings), CROWD * min(spacings), above=True)
    elif law.spacing is not None and law.spacing >= shortest:
        text = f"{apart}, so that none meets another"
        yield _within(recipe, "spacing", text, tightest, shortest)


def _range(values: Sequence[float]) -> str:
    texts = [f"{value:.3g}" for value in (min(values), max(values))]
    return texts[0] if texts[0] == texts[1] else " to ".join(texts)


def _within(recipe: Recipe, key: str, text: str, low: float, high: float, *, above: bool = False) -> Problem:
    """Return the problem of a length that is not between two others (m); of none if nothing is between."""
    if above and _up(low) < _down_to(high):
        text += f", expected re of more than {_mm_up(low)} and at most {_mm_down(high)}, {CHOSEN}"
    elif not above and _up(low) < _down_to(high):
        text += f", expected at least {_mm_up(low)} and less than {_mm_down(high)}, {CHOSEN}"
    else:
        text += ", and no value suits all balloons, expected no such line: the model chooses it"
    return recipe.problem(_place(key), text)


def _regions(recipe: Recipe, radii: Sequence[float]) -> Iterator[Problem]:
    for key in REGIONS:
        value = getattr(recipe.physics.kosaka, key)
        if value is None:
            continue
        most, least = min(radii), THINNEST_REGION * max(radii) if key == "air_offset" else 0.0
        if value > most:
            text = f"{1e3 * value:g} mm is more than the balloon's radius, expected at most {_mm_down(most)}"
            yield recipe.problem(_place(key), f"{text}, {CHOSEN}")
        elif value < least:
            text = f"{1e3 * value:g} mm is so thin that air slips through, expected at least {_mm_up(least)}"
            yield recipe.problem(_place(key), f"{text}, {CHOSEN}")


def _radii(recipe: Recipe, tubes: Mapping[str, BalloonSize]) -> list[float]:
    """Radii of the blown-up balloons, m; none of rubber without a bulged phase, which is told elsewhere."""
    try:
        wide = maxwell_state(rubber_named(recipe.physics.rubber)).bulged.a
    except ValueError:
        return []
    return sorted({wide * size.radius for size in tubes.values()})


def _place(key: str) -> Path:
    return ("physics", "kosaka", key)


def _down(value: float) -> str:
    """Return a value with two digits, rounded down so that what is written still works."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.floor(value / unit + 1e-6) * unit:g}"


def _mm_up(length: float) -> str:
    return f"{_up(length):g} mm"


def _mm_down(length: float) -> str:
    return f"{_down_to(length):g} mm"


def _up(length: float) -> float:
    """Return a length (m) in tenths of millimetres, rounded up, in mm."""
    return math.ceil(1e4 * length - 1e-6) / 10.0


def _down_to(length: float) -> float:
    """Return a length (m) in tenths of millimetres, rounded down, in mm."""
    return math.floor(1e4 * length + 1e-6) / 10.0
