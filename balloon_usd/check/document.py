"""The reports of a call as JSON, for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.stage.properties import PROPERTIES
from balloon_usd.stage.properties.table import BY_PICTURES, BY_TWO_RUNS, IN_BLENDER

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.check.fault import Fault
    from balloon_usd.check.report import Report

FORMAT = 1
"""Version of the document."""

ELSEWHERE = {IN_BLENDER, BY_PICTURES, BY_TWO_RUNS}
"""Ways of testing that one stage on disk does not allow."""


def not_tested() -> dict[str, str]:
    """Properties that a stage alone does not show, by number, with how they are tested."""
    return {str(number): told.where for number, told in PROPERTIES.items() if told.where in ELSEWHERE}


def document_of(reports: Iterable[Report]) -> dict[str, Any]:
    """All faults of all stages, as plain lists and dictionaries."""
    return {"format": FORMAT, "not_tested": not_tested(), "stages": [_stage(report) for report in reports]}


def _stage(report: Report) -> dict[str, Any]:
    result = "unreadable" if report.unreadable else "faults" if report.faults else "fine"
    return {
        "stage": report.stage.encode("utf-8", "backslashreplace").decode(),
        "result": result,
        "unreadable": report.unreadable,
        "kind": report.kind.value,
        "variants": report.selections,
        "variants_left_out": report.left_out,
        "frozen": report.frames,
        "validators": report.validators,
        "not_counted": dict(report.not_counted),
        "faults": [_fault(fault) for fault in report.found],
    }


def _fault(fault: Fault) -> dict[str, Any]:
    return {
        "by": fault.by,
        "rule": fault.rule,
        "prim": fault.prim,
        "time_code": fault.time_code,
        "variants": fault.variants,
        "text": fault.text,
        "remedy": fault.remedy,
    }
