"""One sculpture in the making: its stage and its report."""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from balloon_usd.balloon.detail import detail_named
from balloon_usd.batch.leftovers import remove_failed
from balloon_usd.batch.messages import Made
from balloon_usd.endings import endings_wait
from balloon_usd.files.failed_name import failed_name
from balloon_usd.files.hashes import hashes_of
from balloon_usd.language.choices import all_of
from balloon_usd.origin import provenance_of
from balloon_usd.plan.meshing import meshes_of
from balloon_usd.quality.watch import QualityWatch, counted_over_time
from balloon_usd.report import History, write_report
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.run_summary import RunSummary
from balloon_usd.solver.status import Status
from balloon_usd.stage import StageWriter
from balloon_usd.staging import describe_stage

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from balloon_usd.batch.messages import Part
    from balloon_usd.batch.order import Order
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame
    from balloon_usd.stage import WrittenStage


class NoFrames(Exception):  # noqa: N818
    """A simulation failed before the first frame that is written."""


class Sculpture:
    """Takes the frames of one sculpture, and makes files of them."""

    def __init__(self, part: Part, plan: Plan, order: Order) -> None:
        """Prepare for a plan."""
        self.part = part
        self.failed = ""
        """Why there are no more frames before the last one, once that is known."""
        self._plan, self._order = plan, order
        level = detail_named(order.detail)
        meshes = meshes_of(plan, level)
        self._codes = order.frames.within(plan.frame_count)
        self._run_summary = RunSummary(plan, meshes)
        # Crossings over time are the report's: those who want none want their frames soon.
        counted = counted_over_time(plan, self._codes) if order.report else self._codes[-1:]
        self._quality = QualityWatch(plan, meshes, counted)
        self._history = History(plan, meshes, self._quality.crossings) if order.report else None
        self._open = ExitStack()
        self._writer = StageWriter(describe_stage(plan, meshes), order.folder, **order.form)
        self._status = Status("")
        self._frames = self._last = 0
        self._begun = time.perf_counter()

    def start(self) -> None:
        """Make the hidden files of the stage; raises `StageError` when the folder cannot be written."""
        # Between a folder and the note that it is to be removed no signal may come.
        with endings_wait():
            self._open.enter_context(self._writer)
        self._begun = time.perf_counter()

    def stop(self) -> None:
        """Give up the stage and remove what was written of it; does nothing to a finished one."""
        with endings_wait():
            self._open.close()

    def status_at(self, time_code: int, news: Mapping[int, Mapping[int, Status]]) -> Status:
        """Return the status at a time code, after the news by time code and place."""
        self._status = news.get(time_code, {}).get(self.part.place, self._status)
        return self._status

    def add(self, frame: Frame) -> None:
        """Take the next frame; raises `StageError` when the stage cannot be written."""
        self._run_summary.add(frame)
        self._quality.add(frame)
        if frame.time_code in self._codes:
            if self._history is not None:
                self._history.add(frame)
            self._writer.write(frame)
            self._frames, self._last = self._frames + 1, frame.time_code

    def finish(self) -> Made:
        """Give everything its final name once the last frame is taken, or the simulation has failed.

        Raises:
            NoFrames: the simulation has failed before there was anything to write; nothing is left.
            StageError: the stage cannot be written.
            ReportError: the report cannot be written.
        """
        name, folder = self._plan.recipe.name, self._order.folder
        self.failed = self.failed or self._came_undone()
        if self.failed:
            remove_failed(folder, name)
            if not self._frames:
                raise NoFrames
        written = self._writer.finish(self.failed, self._quality.crossings.facts(self._last))
        self._open.close()
        quality = self._quality.data()
        products = self._products(written, quality)
        if not self.failed:
            remove_failed(folder, name)
        hashes = {file.relative_to(folder).as_posix(): sha256 for file, sha256 in written.sha256.items()}
        hashes |= hashes_of(folder, products["report"])
        return Made(
            self.part.job,
            self.part.batch,
            hashes,
            {key: tuple(f.relative_to(folder).as_posix() for f in found) for key, found in products.items()},
            written.frames,
            written.size,
            self._summary(written, quality),
            time.perf_counter() - self._begun,
            self.failed and f"{self.failed}; {self._what_is_left(written)}",
        )

    def _came_undone(self) -> str:
        """Say at the end what has not held that must; nothing where all has."""
        told = []
        if unkept := list(self._quality.unkept()):
            remedy = "lock twists, wind locks with more turns, or change must_hold"
            told.append(f"{all_of(unkept)}, and must hold: {remedy}")
        told += [f"{each}, or change must_hold" for each in self._quality.stuck_and_slipped()]
        if unwound := self._quality.unwound():
            told.append(f"{all_of(unwound)}: make the bubbles longer, or change must_hold")
        if not told:
            return ""
        last = self._plan.frame_count
        return str(SimulationFailed("hold", (last - 1) / self._plan.recipe.fps, "; ".join(told), last))

    def _products(self, written: WrittenStage, quality: dict[str, Any] | None) -> dict[str, tuple[Path, ...]]:
        """Write the report; return the files of the stage, the shot and the report."""
        report: tuple[Path, ...] = ()
        if self._history is not None:
            report = write_report(
                self._history,
                self._order.folder,
                detail=self._order.detail,
                provenance=provenance_of(self._plan.recipe),
                quality=quality,
                failed=self.failed,
            )
        name = self._plan.recipe.name
        shot = self._order.shot_file(failed_name(name) if self.failed else name)
        shots = tuple(file for file in written.files if file == shot)
        return {"stage": written.files[:1], "shot": shots, "report": report}

    def _what_is_left(self, written: WrittenStage) -> str:
        """Say where the frames before a failure are, and that an earlier stage was left alone."""
        frames = "the frame before is" if written.frames == 1 else f"the {written.frames} frames before are"
        told = f"{frames} in {written.files[0]}"
        earlier = self._order.stage(self._plan.recipe.name)
        return f"{told}; {earlier} stays as an earlier run made it" if earlier.exists() else told

    def _summary(self, written: WrittenStage, quality: dict[str, Any] | None) -> dict[str, object]:
        """What the run came to, in numbers that a table shows."""
        summary, load = self._run_summary, self._run_summary.wall_load
        return {
            "fps": self._plan.recipe.fps,
            "model": self._plan.recipe.physics.model,
            "tails_left": {name: round(tail, 6) for name, tail in summary.tails_left.items()},
            "highest_stretch": round(summary.highest_stretch, 4),
            "burst_stretch": self._plan.recipe.physics.traits.burst_stretch,
            "highest_bubble": summary.highest_bubble,
            "burst_load": round(load.load, 4),
            "most_loaded": load.bubble,
            "bursts": summary.bursts,
            "gas_off": {name: round(share, 3) for name, share in summary.gas_off.items()},
            "hard": {balloon: [bubble, round(p, 1)] for balloon, (bubble, p) in summary.hard.items()},
            "undone": list(summary.undone),
            "stale": list(written.stale),
            "quality": quality,
        }
