"""Physics-true balloon twisting: a YAML recipe becomes an animated USD stage.

    plan = plan_recipe(Recipe.load("recipes/dog.yaml"))
    written = write_stage(plan, simulate(plan), "out")
    draw_contact_sheet(written.files[0], "out/dog.png")

Names load what they need when they are first used: `import balloon_usd` alone costs nothing. Threads may use
them at once; in OpenUSD they take turns, see `balloon_usd.openusd`.
"""

from __future__ import annotations

from importlib import import_module
from threading import RLock
from typing import TYPE_CHECKING

from balloon_usd.version import __version__

if TYPE_CHECKING:
    from balloon_usd.batch.engine import run_batch
    from balloon_usd.batch.error import BatchError, NotKept
    from balloon_usd.batch.machine import Machine
    from balloon_usd.batch.order import FrameRange, Order
    from balloon_usd.batch.record import Record, Status
    from balloon_usd.batch.watch import Watch
    from balloon_usd.check import Report, check_file
    from balloon_usd.diff import Comparison, DiffError, compare_files
    from balloon_usd.exchange.error import NotExportedError
    from balloon_usd.exchange.export import export_stage
    from balloon_usd.mesh_file.error import MeshFileError
    from balloon_usd.plan import (
        AfterStep,
        Plan,
        after_step,
        after_step_json,
        after_step_text,
        plan_json,
        plan_svg,
        plan_text,
    )
    from balloon_usd.plan import plan as plan_recipe
    from balloon_usd.preview import PictureNotWrittenError, PreviewError, draw_contact_sheet
    from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError, recipe_schema
    from balloon_usd.solver.errors import DeviceUnavailable, SimulationFailed
    from balloon_usd.solver.frame import Frame
    from balloon_usd.solver.performance import Performance, simulate
    from balloon_usd.solver.simulation import Simulation, simulate_many
    from balloon_usd.stage import StageError, WrittenStage
    from balloon_usd.staging import describe_stage, write_stage
    from balloon_usd.variation import VariationError, VariationNotWrittenError, Variations, vary_recipe


__all__ = [
    "AfterStep",
    "BatchError",
    "Comparison",
    "DeviceUnavailable",
    "DiffError",
    "Frame",
    "FrameRange",
    "Machine",
    "MeshFileError",
    "NotExportedError",
    "NotKept",
    "Order",
    "Performance",
    "PictureNotWrittenError",
    "Plan",
    "PreviewError",
    "Recipe",
    "RecipeBuilder",
    "RecipeError",
    "Record",
    "Report",
    "Simulation",
    "SimulationFailed",
    "StageError",
    "Status",
    "VariationError",
    "VariationNotWrittenError",
    "Variations",
    "Watch",
    "WrittenStage",
    "__version__",
    "after_step",
    "after_step_json",
    "after_step_text",
    "check_file",
    "compare_files",
    "describe_stage",
    "draw_contact_sheet",
    "export_stage",
    "plan_json",
    "plan_recipe",
    "plan_svg",
    "plan_text",
    "recipe_schema",
    "run_batch",
    "simulate",
    "simulate_many",
    "vary_recipe",
    "write_stage",
]

_EXPORTS = {
    "balloon_usd.batch.engine": ("run_batch",),
    "balloon_usd.batch.error": ("BatchError", "NotKept"),
    "balloon_usd.batch.machine": ("Machine",),
    "balloon_usd.batch.order": ("FrameRange", "Order"),
    "balloon_usd.batch.record": ("Record", "Status"),
    "balloon_usd.batch.watch": ("Watch",),
    "balloon_usd.check": ("Report", "check_file"),
    "balloon_usd.diff": ("Comparison", "DiffError", "compare_files"),
    "balloon_usd.exchange.error": ("NotExportedError",),
    "balloon_usd.exchange.export": ("export_stage",),
    "balloon_usd.mesh_file.error": ("MeshFileError",),
    "balloon_usd.plan": (
        "AfterStep",
        "Plan",
        "after_step",
        "after_step_json",
        "after_step_text",
        "plan_json",
        "plan_svg",
        "plan_text",
    ),
    "balloon_usd.preview": ("PictureNotWrittenError", "PreviewError", "draw_contact_sheet"),
    "balloon_usd.recipe": ("Recipe", "RecipeBuilder", "RecipeError", "recipe_schema"),
    "balloon_usd.solver.errors": ("DeviceUnavailable", "SimulationFailed"),
    "balloon_usd.solver.frame": ("Frame",),
    "balloon_usd.solver.performance": ("Performance", "simulate"),
    "balloon_usd.solver.simulation": ("Simulation", "simulate_many"),
    "balloon_usd.stage": ("StageError", "WrittenStage"),
    "balloon_usd.staging": ("describe_stage", "write_stage"),
    "balloon_usd.variation": ("VariationError", "VariationNotWrittenError", "Variations", "vary_recipe"),
}
_PLACES = {name: (room, name) for room, names in _EXPORTS.items() for name in names}
# The function `plan` cannot have its own name here: `balloon_usd.plan` is its room.
_PLACES["plan_recipe"] = ("balloon_usd.plan", "plan")

_LOADING = RLock()
"""Python may give half a package to threads that load parts of it at once."""


def __getattr__(name: str) -> object:
    """Load a name of the package on first use."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    room, there = _PLACES[name]
    with _LOADING:
        globals()[name] = found = getattr(import_module(room), there)
    return found


def __dir__() -> list[str]:
    """List the names that are not loaded yet, too."""
    return sorted({*globals(), *_PLACES})
