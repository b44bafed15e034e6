"""Simulate plans together and stream their frames to their stages."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.progress import show_progress
from balloon_usd.cli.stage_writer import stage_writers
from balloon_usd.report import History
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many
from balloon_usd.solver.tally import Tally
from balloon_usd.stage import StageError
from balloon_usd.staging import describe_stage

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from balloon_usd.cli.form import Form
    from balloon_usd.cli.frame_range import FrameRange
    from balloon_usd.cli.stage_writer import StageWriter
    from balloon_usd.plan import Plan
    from balloon_usd.solver.simulation import Simulation
    from balloon_usd.stage import WrittenStage


@dataclass(frozen=True)
class Order:
    """How stages are wanted."""

    folder: Path
    detail: str
    device: str
    form: Form
    frames: FrameRange
    lines: bool
    """Progress in lines for programs."""


class _Seen(NamedTuple):
    """What has been seen of a plan so far."""

    plan: Plan
    tally: Tally
    history: History


@dataclass(frozen=True)
class Outcome:
    """What became of one plan."""

    plan: Plan
    tally: Tally
    history: History
    """The frames that were written."""
    written: WrittenStage | None = None
    failed: SimulationFailed | None = None


def together(plans: Iterable[Plan]) -> list[list[Plan]]:
    """Group plans that can advance in one simulation: one frame rate and one surrounding physics."""
    groups: dict[object, list[Plan]] = defaultdict(list)
    for plan in plans:
        physics = plan.recipe.physics.model_dump(exclude={"hold", "leak", "rubber", "softening", "kosaka"})
        groups[plan.recipe.fps, *physics.values()].append(plan)
    return list(groups.values())


def perform(plans: Sequence[Plan], order: Order) -> list[Outcome]:
    """Simulate plans that advance together and write their stages.

    Raises:
        Failure: the range of frames lies outside an animation, or a stage cannot be written.
    """
    simulation = simulate_many(plans, detail=order.detail, device=order.device)
    try:
        wanted = [order.frames.within(count) for count in simulation.frame_counts]
    except ValueError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error
    pairs = zip(plans, simulation.meshes, strict=True)
    descriptions = [describe_stage(plan, meshes) for plan, meshes in pairs]
    with stage_writers(descriptions, order.folder, order.detail, order.form) as writers:
        return _stream(plans, simulation, wanted, writers, lines=order.lines)


def _stream(
    plans: Sequence[Plan],
    simulation: Simulation,
    wanted: Sequence[range],
    writers: Sequence[StageWriter],
    *,
    lines: bool,
) -> list[Outcome]:
    """Pass frames on until every plan has its last one wanted, or has failed."""
    outcomes: list[Outcome | None] = [None] * len(plans)
    seen = [
        _Seen(plan, Tally(plan, meshes), History(plan, meshes))
        for plan, meshes in zip(plans, simulation.meshes, strict=True)
    ]
    with show_progress(sum(codes[-1] for codes in wanted), lines=lines) as shown:
        for frames in simulation.frames():
            advanced = [frame for frame in frames if isinstance(frame, Frame)]
            for world, frame in enumerate(frames):
                if outcomes[world] is None:
                    outcomes[world] = _pass_on(seen[world], frame, wanted[world], writers[world])
            running = sum(outcome is None for outcome in outcomes)
            shown.advance(_doing(advanced, running), len(advanced))
            if running == 0:
                break
    return [outcome for outcome in outcomes if outcome is not None]


def _pass_on(
    seen: _Seen, frame: Frame | SimulationFailed | None, wanted: range, writer: StageWriter
) -> Outcome | None:
    """Hand a frame to its writer; return the outcome when it was the last."""
    if isinstance(frame, SimulationFailed):
        writer.stop()
        return Outcome(*seen, failed=frame)
    if frame is None:
        return None
    seen.tally.add(frame)
    try:
        if frame.time_code in wanted:
            seen.history.add(frame)
            writer.put(frame)
        return Outcome(*seen, written=writer.finish()) if frame.time_code == wanted[-1] else None
    except StageError as error:
        raise Failure(f"{seen.plan.recipe.file}: {error}", ExitCode.NOT_WRITTEN) from error


def _doing(frames: Sequence[Frame], running: int) -> str:
    """Say what the hands do, of the first that moves when there are several."""
    if not frames:
        return "done"
    return frames[0].doing if running <= 1 else f"{running} sculptures, {frames[0].doing}"
