"""Ray as the engine of a batch: each chunk of recipes is a task on one of the machines of a cluster."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.ray_cluster import ClusterError, one_line, ray_cluster

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from types import ModuleType

    Make = Callable[[Sequence[str]], list[dict[str, Any]]]
    """Makes the recipes of a chunk and returns a record of each; what is there already is left as it is."""

RETRIES = 10
"""Times that a chunk begins anew after its worker or machine was lost, or its folder could not be reached."""
SECONDS_TO_END = 5.0
"""Time that tasks have to clear up when nobody waits for them any more, s."""


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


@dataclass(frozen=True)
class Ended:
    """A chunk that is no longer worked on."""

    chunk: tuple[str, ...]
    records: list[dict[str, Any]] = field(default_factory=list)
    lost: str | None = None
    """Why there are no records, in one line."""


def make_on_cluster(
    chunks: Iterable[Sequence[str]], make: Make, needs: Needs, address: str | None = None
) -> Iterator[Ended]:
    """Make chunks of recipes on a Ray cluster and yield each as it ends.

    A chunk whose worker or machine is lost begins anew elsewhere, and so does one in which `make` raises an
    OSError. Any other exception ends its chunk alone. Tasks end with the iterator.

    Args:
        chunks: paths, which all machines must see alike.
        make: is pickled, so all that it needs must be installed on all machines.
        needs: CUDA_VISIBLE_DEVICES holds as many GPUs as a task needs.
        address: HOST:PORT of the cluster; None starts one on this machine.

    Raises:
        ClusterError: the cluster cannot be used, or no machine in it has what a task needs.
    """
    with ray_cluster(address) as ray:
        _require_machine(ray, needs)
        task = _task(ray, make, needs)
        waiting = {task.remote(list(chunk)): tuple(chunk) for chunk in chunks}
        try:
            while waiting:
                (first, *_), _ = ray.wait(list(waiting))
                yield _ended(ray, first, waiting.pop(first))
        finally:
            _end(ray, list(waiting))


def _task(ray: ModuleType, make: Make, needs: Needs) -> Any:
    """Return the remote function; a plain one, as Ray takes no other callables."""

    def make_chunk(chunk: list[str]) -> list[dict[str, Any]]:
        return make(chunk)

    return ray.remote(
        num_cpus=needs.cpus,
        num_gpus=needs.gpus,
        max_retries=RETRIES,
        retry_exceptions=[OSError],
        # Or a process serves only one task that has a GPU; what uses CUDA are processes that `make` starts.
        max_calls=0,
        scheduling_strategy="SPREAD",
    )(make_chunk)


def _ended(ray: ModuleType, task: Any, chunk: tuple[str, ...]) -> Ended:
    try:
        return Ended(chunk, ray.get(task))
    except ray.exceptions.RayTaskError as error:
        return Ended(chunk, lost=f"{type(error.cause).__name__}: {one_line(error.cause)}")
    except ray.exceptions.RayError as error:
        return Ended(chunk, lost=f"lost {RETRIES + 1} times ({type(error).__name__}: {one_line(error)})")


def _end(ray: ModuleType, tasks: list[Any]) -> None:
    """End tasks as Ctrl-C ends a run, and give them time for it."""
    for task in tasks:
        ray.cancel(task)
    if tasks:
        ray.wait(tasks, num_returns=len(tasks), timeout=SECONDS_TO_END)


def _require_machine(ray: ModuleType, needs: Needs) -> None:
    """Check that a task can run somewhere: Ray would wait for such a machine for ever."""
    resources = [node["Resources"] for node in ray.nodes() if node["Alive"]]
    machines = [Needs(each.get("CPU", 0), each.get("GPU", 0)) for each in resources]
    if not any(has.cpus >= needs.cpus and has.gpus >= needs.gpus for has in machines):
        has = "; ".join(sorted({str(machine) or "nothing" for machine in machines}))
        raise ClusterError(f"a task needs {needs}, and no machine of the cluster has that (they have {has})")
