"""Left and right in the names of a shipped figure are its own left and right."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from balloon_usd.operations.moves import Gather, LetGo
from balloon_usd.operations.table import OPERATIONS
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.motions.closing import ClosingChain
from balloon_usd.solver.sculpture import ALONG
from balloon_usd.solver.simulation import simulate_many
from tests.sculptures.sides import middle_of, pairs

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "recipes").rglob("*.yaml"))
TEXTS = {str(path.relative_to(ROOT / "recipes")): path for path in FILES}
EXAMPLES = {f"{operation.word} example": operation.example for operation in OPERATIONS}
SIDED = [path for path in FILES if path.parent.name in ("recipes", "book")]
GAP = 0.005


def closed_side(planned, move, bubble):
    """How far +y the middle of a bubble of a chain lies, once the hands have closed the chain, m."""
    table = planned.table
    corners = [ring for ring in move.corners if table.rings[ring].joint]
    sides = [each for each in planned.bubbles if table.ends(each.name)[1] in corners[1:]]
    loop = len(sides) == 1
    lengths = np.full(8, sides[0].length / 8) if loop else np.array([each.length for each in sides])
    ways = ALONG, np.array(move.point), np.array(move.across)
    places = ClosingChain(lengths, *ways, GAP).pose(1.0)
    own = places if loop else places[(k := [each.name for each in sides].index(bubble)) : k + 2]
    return own.mean(axis=0)[1]


def sides_of(planned):
    """How far +y the hands bring each bubble of a chain that they close, m."""
    found = {}
    for move in planned.choreography.moves:
        if isinstance(move, Gather):
            first, last = (planned.table.rings[ring] for ring in (move.corners[0], move.corners[-1]))
            row = [bubble.name for bubble in planned.strips[last.balloon].bubbles]
            begin = 0 if first.name.endswith(".knot") else row.index(first.bubble) + 1
            found.update(
                {
                    name: closed_side(planned, move, name)
                    for name in row[begin : row.index(last.bubble) + 1]
                    # Closed rows hang on the chain.
                    if planned.table.ends(name)[1] in move.corners
                }
            )
    return found


@pytest.mark.parametrize("source", [*TEXTS, *EXAMPLES])
def test_hands_bring_what_is_called_left_to_the_left_of_what_is_called_right(source):
    recipe = Recipe.load(TEXTS[source]) if source in TEXTS else Recipe.parse(EXAMPLES[source])
    planned = plan(recipe)
    sides = sides_of(planned)
    for left, right, sign in pairs(planned):
        on_one = len({each.balloon for each in planned.bubbles if each.name in (left, right)}) == 1
        if on_one and left in sides and right in sides:
            assert sign * (sides[left] - sides[right]) > 1e-4, left


@pytest.mark.long
@pytest.mark.parametrize("path", SIDED, ids=lambda path: path.stem)
def test_what_is_called_left_lies_left_in_the_finished_figure(path):
    planned = plan(Recipe.load(path))
    if not list(pairs(planned)):
        return
    simulation = simulate_many([planned], detail="draft", device="cpu")
    over = next(m.start for m in planned.choreography.moves if isinstance(m, LetGo) and m.for_good)
    for (frame,) in simulation.frames():
        assert isinstance(frame, Frame), frame
        # What comes undone when the hands let go turns about itself.
        if planned.loose and frame.time_code > over * simulation.fps:
            break
    for left, right, sign in pairs(planned):
        one, other = (middle_of(simulation, frame, name)[1] for name in (left, right))
        assert sign * (one - other) > 5e-3, f"{left} {one * 1e3:.0f} mm, {right} {other * 1e3:.0f} mm"
