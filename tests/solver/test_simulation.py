"""Simulations of small balloons: batches, bits, failures."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import BURST_STRETCH
from balloon_usd.operations.moves import Press
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeBuilder
from balloon_usd.solver.errors import DeviceUnavailable, SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.run_summary import RunSummary
from balloon_usd.solver.simulation import simulate_many

SHORT = """
format: 1
name: {name}
units: cm
fps: 12
balloons:
  main: {{size: 260, length: {length}, tail: {tail}, color: red}}
steps:
  - {kind}: {{head: {head}}}
  - rest: tail
physics: {physics}
"""


def short(name="short", head=6, tail=3, kind="bubbles", physics="{hold: 0.2}", length=9):
    words = {"name": name, "head": head, "tail": tail, "kind": kind, "physics": physics, "length": length}
    return plan(Recipe.parse(SHORT.format(**words)))


def bursting():
    """A loop that takes two thirds of a balloon without tail."""
    return short("bursting", head=9, tail=0, kind="loop", physics="{hold: 0.2, burst: stop}", length=3.4)


def last_frames(plans, device="cpu"):
    last = [None] * len(plans)
    for frames in simulate_many(plans, detail="draft", device=device).frames():
        for world, frame in enumerate(frames):
            last[world] = frame if frame is not None else last[world]
    return last


def summarised(plan):
    """The summary of a whole run, and its last frame."""
    simulation = simulate_many([plan], detail="draft", device="cpu")
    summary = RunSummary(plan, simulation.meshes[0])
    for (frame,) in simulation.frames():
        assert isinstance(frame, Frame), frame
        summary.add(frame)
    return summary, frame


PRESSED = """
format: 1
name: pressed
units: cm
balloons:
  main: {size: 260, length: 9, tail: 3, color: red}
steps:
  - press: {bubble: main_rest, depth: 1}
    seconds: 1
physics: {model: MODEL, hold: 0.2}
"""


@pytest.mark.parametrize("model", ["latex", pytest.param("kosaka", marks=pytest.mark.long)])
def test_a_finger_stays_on_its_balloon_beside_another_sculpture(model):
    pressed = plan(Recipe.parse(PRESSED.replace("MODEL", model)))
    other = plan(Recipe.parse(PRESSED.replace("MODEL", model).replace("depth: 1", "depth: 0.1")))
    (press,) = (move for move in pressed.choreography.moves if isinstance(move, Press))

    def dent(plans):
        frames = [f[0].points[0] for f in simulate_many(plans, detail="draft").frames() if f[0] is not None]
        begin = round(pressed.recipe.fps * press.start)
        return max(float((frames[begin] - points)[:, 2].max()) for points in frames[begin:])

    beside = dent([pressed, other])
    assert beside == pytest.approx(dent([pressed]), abs=1e-3)
    assert beside > dent([other]) + 3e-3


class Watched:
    """A simulation of one small balloon: how many frames it announced, all of them, and its gas in each, mol."""

    def __init__(self):
        simulation = simulate_many([short()], detail="draft", device="cpu")
        (self.announced,) = simulation.frame_counts
        self.frames, self.gas = [], []
        for (frame,) in simulation.frames():
            self.frames.append(frame)
            self.gas.append(simulation.model.scene.amount.numpy()[2:].sum())


@pytest.fixture(scope="module")
def watched():
    return Watched()


def test_frames_are_counted_from_one_and_announced_in_advance(watched):
    codes = [frame.time_code for frame in watched.frames]
    assert codes == list(range(1, watched.announced + 1))


def test_the_first_frame_is_flat_and_the_last_has_a_full_bubble(watched):
    frames = watched.frames
    assert frames[0].volume.sum() < 8e-6
    assert frames[-1].volume[0] > 80e-6
    assert frames[-1].pressure[0] > 6000.0


def test_gas_is_neither_lost_nor_won_once_the_pump_has_stopped(watched):
    amounts = [
        gas
        for frame, gas in zip(watched.frames, watched.gas, strict=True)
        if frame.doing.startswith(("pinch", "twist"))
    ]
    assert len(amounts) > 5
    assert np.ptp(amounts) / amounts[0] < 1e-6


def test_a_burst_stops_the_run_when_the_recipe_says_so():
    figure = bursting()
    stopped = last_frames([figure])[0]
    assert isinstance(stopped, SimulationFailed)
    assert "loop twist: head: head bursts" in str(stopped)
    assert "main may burst at the twist that ends head" in [caution.what for caution in figure.cautions]


def test_a_loop_that_the_plan_calls_safe_does_not_burst_though_its_crease_is_stretched_beyond_seven():
    figure = short(head=10, kind="loop", physics="{hold: 0.2, burst: stop}")
    assert not any("burst" in caution.what for caution in figure.cautions)
    summary, _ = summarised(figure)
    assert summary.highest_stretch > BURST_STRETCH
    assert 0.6 < summary.wall_load.load < 1.0
    assert not summary.bursts


def test_a_run_without_tail_tells_its_hardest_bubble():
    figure = short(tail=0, physics="{hold: 0}")
    summary, frame = summarised(figure)
    hardest = figure.bubbles[int(np.argmax(frame.pressure))].name
    ((balloon, (bubble, pressure)),) = summary.hard.items()
    assert (balloon, bubble) == ("main", hardest)
    assert pressure == frame.pressure.max() > 7.2e3


def test_one_failure_in_a_batch_leaves_the_others_alone():
    alone = last_frames([short(physics="{hold: 0.2, burst: stop}")])[0]
    failed, fine = last_frames([bursting(), short(physics="{hold: 0.2, burst: stop}")])
    assert isinstance(failed, SimulationFailed)
    assert isinstance(fine, Frame)
    assert np.array_equal(alone.points[0], fine.points[0])


def test_a_device_that_is_not_there_is_named_with_those_that_are():
    with pytest.raises(DeviceUnavailable, match="cpu"):
        simulate_many([short()], detail="draft", device="cuda:17")


def test_a_recipe_made_in_python_runs_too():
    builder = RecipeBuilder("small").balloon("main", size="260", length=0.06, tail=0.03)
    recipe = builder.bubbles(head=0.04, seconds=0.5).rest("tail").build()
    simulation = simulate_many([plan(recipe)], detail="draft", device="cpu")
    assert isinstance(next(iter(simulation.frames()))[0], Frame)
