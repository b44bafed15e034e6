"""The machines of a Ray cluster: whether they can do what is asked of them, before any work is given out."""

from __future__ import annotations

import secrets
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.ray_cluster import ClusterError, one_line
from balloon_usd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from types import ModuleType

ANSWER_SECONDS = 60.0
"""Time in which a machine must say that it is ready, s."""
FILE_SECONDS = 5.0
"""Time in which a new file must be seen on other machines, s."""


@dataclass(frozen=True)
class Needs:
    """What a task takes of its machine while it runs."""

    cpus: float = 1
    gpus: float = 0

    def __str__(self) -> str:
        """Name them, as in `2 CPUs and 1 GPU`."""
        named = [
            f"{count:g} {name}{'' if count == 1 else 's'}"
            for count, name in ((self.cpus, "CPU"), (self.gpus, "GPU"))
            if count
        ]
        return " and ".join(named)


def usual_needs(ray: ModuleType) -> Needs:
    """Return one GPU with its share of the processors, or one processor where there are no GPUs."""
    has = ray.cluster_resources()
    gpus, cpus = has.get("GPU", 0), has.get("CPU", 1)
    return Needs(max(1, int(cpus // gpus)), 1) if gpus >= 1 else Needs()


def require_machines(ray: ModuleType, needs: Needs, folder: Path) -> None:
    """Check that the cluster can do the work and that every machine of it is set up alike.

    One machine that is not would fail task after task in no time, or leave stages on its own disk.

    Args:
        ray: connected.
        needs: of a task.
        folder: absolute; it exists here and must be the same one on every machine.

    Raises:
        ClusterError: no machine has what a task needs, or balloon_usd is missing or another one somewhere, or
            the folder is not shared; one line a problem.
    """
    nodes = [node for node in ray.nodes() if node["Alive"]]
    machines = [Needs(node["Resources"].get("CPU", 0), node["Resources"].get("GPU", 0)) for node in nodes]
    if not any(has.cpus >= needs.cpus and has.gpus >= needs.gpus for has in machines):
        has = "; ".join(sorted({str(machine) or "nothing" for machine in machines}))
        raise ClusterError(f"a task needs {needs}, and no machine of the cluster has that (they have {has})")
    with _mark_in(folder) as mark:
        problems = _ask_all(ray, nodes, mark)
    if problems:
        raise ClusterError("\n".join(sorted(problems)))


@contextmanager
def _mark_in(folder: Path) -> Iterator[Path]:
    """Leave a file by which the folder is known."""
    mark = folder / f".balloon_usd.{secrets.token_hex(8)}.shared"
    try:
        mark.touch(exist_ok=False)
        yield mark
    finally:
        mark.unlink(missing_ok=True)


def _ask_all(ray: ModuleType, nodes: list[dict[str, Any]], mark: Path) -> set[str]:
    """Ask every machine at once whether it is ready, also those that are at work; return what they lack."""
    from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy  # noqa: PLC0415

    question = _question(ray)
    asked = {
        question.options(
            scheduling_strategy=NodeAffinitySchedulingStrategy(node["NodeID"], soft=False)
        ).remote(str(mark), __version__, FILE_SECONDS): node["NodeManagerHostname"]
        for node in nodes
    }
    ready, silent = ray.wait(list(asked), num_returns=len(asked), timeout=ANSWER_SECONDS)
    problems = {f"{asked[each]}: does not answer" for each in silent}
    for each in ready:
        try:
            why = ray.get(each)
        except ray.exceptions.RayError as error:
            why = one_line(error)
        if why:
            problems.add(f"{asked[each]}: {why}")
    return problems


def _question(ray: ModuleType) -> Any:
    """Return the remote function that tells what a machine lacks, "" if nothing."""

    def why_not(path: str, version: str, patience: float) -> str:
        # Runs where balloon_usd may be missing: it is pickled whole and needs nothing from here.
        import time  # noqa: PLC0415
        from pathlib import Path  # noqa: PLC0415

        try:
            from balloon_usd.version import __version__ as found  # noqa: PLC0415
        except ImportError:
            return f"balloon_usd is not installed, expected version {version}"
        if found != version:
            return f"balloon_usd is of version {found}, expected {version} as here"
        end = time.monotonic() + patience
        while not Path(path).exists():
            if time.monotonic() > end:
                folder = Path(path).parent
                return f"{folder} is not the folder of this name here, share it with all machines"
            time.sleep(0.1)
        return ""

    return ray.remote(num_cpus=0, max_retries=0)(why_not)
