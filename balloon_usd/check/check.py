"""One stage, looked at in every variant, by every property and every validator."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from balloon_usd.check.fault import fault_of
from balloon_usd.check.flattened import flattened_equals_composed
from balloon_usd.check.frozen import frames_to_freeze, frozen
from balloon_usd.check.leftovers import nothing_left_over
from balloon_usd.check.noise import why_not_counted
from balloon_usd.check.nvidia import Asked, ask_nvidia, nvidia_installed, nvidia_name
from balloon_usd.check.opening import UnreadableError, open_whole
from balloon_usd.check.place import stage_file
from balloon_usd.check.report import Report
from balloon_usd.check.usd_core import NAME, ask_usd_core
from balloon_usd.openusd import Tf, usd_access
from balloon_usd.stage.opening import said_by, streaming
from balloon_usd.stage.properties import PROPERTIES, check_selections, kind_of
from balloon_usd.stage.variant_sets import LOOK

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from balloon_usd.check.fault import Fault
    from balloon_usd.stage.properties import Selection


MOST = 100
"""Selections of variants that are looked at: sets of variants multiply without end."""


@usd_access()
def check_file(stage: str | Path, *, nvidia: bool = True) -> Report:
    """Look for everything that is wrong with a stage: a USD file, or a folder NAME as `run` writes it.

    Nothing is written. Memory does not grow with the number of frames, but with NVIDIA's validator, which
    holds all samples of a layer. `nvidia`: ask that where it is installed.
    """
    name = str(stage)
    asked = nvidia and nvidia_installed()
    report = Report(name, asks_nvidia=asked, misses_nvidia=nvidia and not asked)
    with streaming():
        try:
            file = stage_file(name)
            _check(file, open_whole(file), report)
        except UnreadableError as error:
            report.unreadable = str(error)
        except (Tf.ErrorException, UnicodeDecodeError) as error:
            # A damaged file may open, and break off where its values are read.
            said = said_by(error) if isinstance(error, Tf.ErrorException) else "text that is no UTF-8"
            report.unreadable = f"{name}: damaged: a value cannot be read: {said}".removesuffix(": ")
    return report


def _check(file: Path, stage: Any, report: Report) -> None:
    report.kind = kind_of(stage)
    report.validators = [NAME, *([nvidia_name()] if report.asks_nvidia else [])]
    for finding in nothing_left_over(file):
        report.add(fault_of(finding), "")
    own: Selection | None = None
    known: set[str] = set()
    for selection, selected, findings in check_selections(stage):
        if len(report.selections) == MOST:
            report.left_out = True
            break
        own = selection if own is None else own
        report.selections.append(_words(selection))
        variants = _words({key: value for key, value in selection.items() if own.get(key) != value})
        for finding in findings:
            report.add(fault_of(finding), variants)
        # Looks share their geometry, which is what takes time.
        geometry = _words({key: value for key, value in selection.items() if key != LOOK})
        _ask(selected, report, variants, Asked.LOOKS if geometry in known else Asked.ALL)
        if geometry not in known:
            known.add(geometry)
            _freeze(selected, report, variants)


def _freeze(stage: Any, report: Report, variants: str) -> None:
    """Look at the stage as it stands still: its first, middle and last frame, or itself."""
    times = frames_to_freeze(stage)
    if not report.frames:
        report.frames = times
    for time in times:
        with frozen(stage, time):
            _ask(stage, report, variants, Asked.SHAPES, time)
            _flatten(stage, report, variants)
    if not times:
        _flatten(stage, report, variants)


def _flatten(stage: Any, report: Report, variants: str) -> None:
    if report.kind in PROPERTIES[31].kinds:
        for finding in flattened_equals_composed(stage):
            report.add(fault_of(finding), variants)


def _ask(stage: Any, report: Report, variants: str, asked: Asked, time_code: float | None = None) -> None:
    """Ask the validators, and keep apart what does not count."""
    for fault in _said(stage, asked, nvidia=report.asks_nvidia):
        why = why_not_counted(fault.rule, fault.text)
        if why:
            report.not_counted[why] += 1
        elif fault.at("") not in report.faults:
            report.add(replace(fault, time_code=time_code), variants)


def _said(stage: Any, asked: Asked, *, nvidia: bool) -> Iterator[Fault]:
    yield from ask_usd_core(stage)
    if nvidia:
        yield from ask_nvidia(stage, asked)


def _words(selection: Selection) -> str:
    """A selection as text, such as "detail=draft look=clay"."""
    return " ".join(f"{name}={variant}" for name, variant in selection.items())
