"""A report for people: grouped by rule, a few of each."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from balloon_usd.check.fault import OURS
from balloon_usd.check.nvidia import INSTALL
from balloon_usd.stage.properties import PROPERTIES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.check.fault import Fault
    from balloon_usd.check.report import Report

SHOWN = 3
"""Faults of one rule that are told one by one."""


def text_of(report: Report) -> str:
    """What was found, a few lines a rule; what cannot be read is one line."""
    if report.unreadable:
        return report.unreadable
    return "\n".join([*_head(report), *_groups(report), *_foot(report)])


def _head(report: Report) -> Iterator[str]:
    count = len(report.faults)
    result = "fine" if not count else "1 fault" if count == 1 else f"{count} faults"
    yield f"{report.stage}: {result} ({report.kind.value}, {_looked_at(report)})"


def _looked_at(report: Report) -> str:
    variants = len(report.selections)
    if report.left_out:
        return f"the first {variants} selections of variants, others were not looked at"
    return "1 selection of variants" if variants == 1 else f"{variants} selections of variants"


def _groups(report: Report) -> Iterator[str]:
    for (by, rule), faults in groupby(report.found, key=lambda fault: fault.kind):
        group = list(faults)
        if by == OURS:
            yield f"  property {rule}: {PROPERTIES[int(rule)].says}"
        else:
            yield f"  {rule} ({by})"
        for fault in group[:SHOWN]:
            yield f"    {_line(fault)}"
        if len(group) > SHOWN:
            yield f"    and {len(group) - SHOWN} more"
        for remedy in dict.fromkeys(fault.remedy for fault in group[:SHOWN]):
            yield f"    remedy: {remedy}"


def _line(fault: Fault) -> str:
    when = "" if fault.time_code is None else f" at time code {fault.time_code:g}"
    where = f"{fault.prim}{when}: " if fault.prim or when else ""
    variants = f" [{fault.variants}]" if fault.variants else ""
    return f"{where.lstrip()}{fault.text}{variants}"


def _foot(report: Report) -> Iterator[str]:
    for why, count in report.not_counted.items():
        yield f"  not counted: {count} x {why}"
    if report.misses_nvidia:
        yield f"  NVIDIA's validator is not installed and was not asked: {INSTALL}"
