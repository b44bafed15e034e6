"""The farm room: many recipes as one job of a render farm, in the format Open Job Description (OpenJD)."""

from __future__ import annotations

from balloon_usd.farm.chunks import chunk_lines, chunk_of_line, chunk_size, in_chunks
from balloon_usd.farm.folders import default_below, recipe_folder
from balloon_usd.farm.job_template import JobTemplate
from balloon_usd.farm.task_log import TaskLog
from balloon_usd.farm.template_file import ENDINGS, template_text, write_template

__all__ = [
    "ENDINGS",
    "JobTemplate",
    "TaskLog",
    "chunk_lines",
    "chunk_of_line",
    "chunk_size",
    "default_below",
    "in_chunks",
    "recipe_folder",
    "template_text",
    "write_template",
]
