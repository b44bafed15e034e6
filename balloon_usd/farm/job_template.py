"""The job template: what a farm needs to know of a job, after the specification `jobtemplate-2023-09`.

https://github.com/OpenJobDescription/openjd-specifications/wiki/2023-09-Template-Schemas
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from balloon_usd.version import __version__

SPECIFICATION = "jobtemplate-2023-09"
DETAILS = ("draft", "preview", "full")
MOST_BYTES = 1 << 20
"""Of one embedded file: what the Rust implementation of OpenJD takes. More chunks become further steps."""
SECONDS_TO_END = 30
"""Time that an interrupted task has to clear up before it is killed, s."""


@dataclass(frozen=True)
class JobTemplate:
    """A job whose tasks each make one chunk of recipes."""

    name: str
    """What people see of the job, at most 128 characters without braces."""
    chunks: str
    """A line a chunk, see `chunk_lines`."""
    recipes: str | None
    """Default folder of the recipes, seen from the template; None if it must be given with the job."""
    output: str | None
    """Default folder of the stages, likewise."""
    detail: str
    """Default level of detail."""
    options: tuple[str, ...] = ()
    """Further options of `balloon-usd run`."""
    gpus: int = 0
    """GPUs that a machine must have."""

    @property
    def tasks(self) -> int:
        """How many tasks there are: one a chunk."""
        return self.chunks.count("\n")

    def document(self) -> dict[str, Any]:
        """Return the template as OpenJD reads it."""
        return {
            "specificationVersion": SPECIFICATION,
            "name": self.name,
            "description": f"Written by balloon-usd farm-template, version {__version__}",
            "parameterDefinitions": self._parameters(),
            "steps": [self._step(number, part) for number, part in enumerate(self._parts(), start=1)],
        }

    def _parts(self) -> list[list[str]]:
        """Divide the lines of the chunks into parts that an embedded file can hold."""
        parts: list[list[str]] = []
        left = 0
        for line in self.chunks.removesuffix("\n").split("\n"):
            size = len(line.encode()) + 1
            if size > left:
                parts.append([])
                left = MOST_BYTES
            parts[-1].append(f"{line}\n")
            left -= size
        return parts

    def _parameters(self) -> list[dict[str, Any]]:
        return [
            _folder("Recipes", "IN", self.recipes, "Folder of the recipes"),
            _folder("Output", "OUT", self.output, "Folder for the stages; made if need be"),
            _text("Detail", self.detail, "How fine the mesh and the time steps are", DETAILS),
            _text(
                "Command", "balloon-usd", "Program on the machines of the farm, found by PATH or by its path"
            ),
        ]

    def _step(self, number: int, chunks: list[str]) -> dict[str, Any]:
        # A list of values would end at 1024, a range does not.
        chunk = {"name": "Chunk", "type": "INT", "range": f"1-{len(chunks)}"}
        step = {"name": f"Sculptures {number}", "parameterSpace": {"taskParameterDefinitions": [chunk]}}
        if self.gpus:
            step["hostRequirements"] = {"amounts": [{"name": "amount.worker.gpu", "min": self.gpus}]}
        return {**step, "script": self._script("".join(chunks))}

    def _script(self, chunks: str) -> dict[str, Any]:
        task = ["farm-task", "{{Task.File.Chunks}}", "{{Task.Param.Chunk}}", "{{Param.Recipes}}", "--"]
        run = ["--output", "{{Param.Output}}", "--detail", "{{Param.Detail}}", *self.options]
        end = {"mode": "NOTIFY_THEN_TERMINATE", "notifyPeriodInSeconds": SECONDS_TO_END}
        return {
            "actions": {"onRun": {"command": "{{Param.Command}}", "args": [*task, *run], "cancelation": end}},
            "embeddedFiles": [{"name": "Chunks", "type": "TEXT", "filename": "chunks.jsonl", "data": chunks}],
        }


def _folder(name: str, flow: str, default: str | None, description: str) -> dict[str, Any]:
    given = {} if default is None else {"default": default}
    kind = {"name": name, "type": "PATH", "objectType": "DIRECTORY", "dataFlow": flow}
    return {**kind, **given, "description": description}


def _text(name: str, default: str, description: str, choices: tuple[str, ...] = ()) -> dict[str, Any]:
    allowed = {"allowedValues": list(choices)} if choices else {}
    return {"name": name, "type": "STRING", "default": default, **allowed, "description": description}
