"""The report room: what every bubble did while it was made, as numbers and as a figure.

Needs no USD and no device: a `History` takes frames as they come and keeps a few numbers of each.
"""

from __future__ import annotations

from balloon_usd.report.document import REPORT_FORMAT, report_data, report_text
from balloon_usd.report.error import ReportError
from balloon_usd.report.figure import draw_figure
from balloon_usd.report.history import History
from balloon_usd.report.step_marks import StepMark, step_marks
from balloon_usd.report.write import report_files, write_report

__all__ = [
    "REPORT_FORMAT",
    "History",
    "ReportError",
    "StepMark",
    "draw_figure",
    "report_data",
    "report_files",
    "report_text",
    "step_marks",
    "write_report",
]
