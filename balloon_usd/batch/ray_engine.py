"""Ray as the engine of a batch: each chunk of recipes is a task on one of the machines of a cluster."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.ray_cluster import one_line, ray_cluster
from balloon_usd.batch.ray_machines import Needs, require_machines, usual_needs

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path
    from types import ModuleType

    Make = Callable[[Sequence[str]], list[dict[str, Any]]]
    """Makes the recipes of a chunk and returns a record of each; what is there already is left as it is."""

RETRIES = 10
"""Times that a chunk begins anew after its worker or machine was lost, or its folder could not be reached."""
SECONDS_TO_END = 5.0
"""Time that tasks have to clear up when nobody waits for them any more, s."""


@dataclass(frozen=True)
class Ended:
    """A chunk that is no longer worked on."""

    chunk: tuple[str, ...]
    records: list[dict[str, Any]] = field(default_factory=list)
    lost: str | None = None
    """Why there are no records, in one line."""


def make_on_cluster(
    chunks: Iterable[Sequence[str]],
    make: Make,
    needs: Needs | None,
    folder: Path,
    address: str | None = None,
) -> Iterator[Ended]:
    """Make chunks of recipes on a Ray cluster and yield each as it ends.

    A chunk whose worker or machine is lost begins anew elsewhere, and so does one in which `make` raises an
    OSError. Any other exception ends its chunk alone. Tasks end with the iterator.

    Args:
        chunks: absolute paths of recipes.
        make: is pickled.
        needs: of a task. CUDA_VISIBLE_DEVICES names the GPUs that are its own, and is left alone where it
            needs none. None takes one GPU and its share of the processors, or one processor without GPUs.
        folder: where `make` writes, absolute; all machines must see it, as they must see the recipes.
        address: HOST:PORT of the cluster; None starts one on this machine.

    Raises:
        ClusterError: the cluster cannot be used, or a machine of it; one line a problem.
    """
    with ray_cluster(address) as ray:
        needs = needs or usual_needs(ray)
        require_machines(ray, needs, folder)
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
    except ray.exceptions.RayError as error:
        # What `make` raised is the cause, else it is Ray that gives up.
        cause = getattr(error, "cause", None) or error
        return Ended(chunk, lost=f"{type(cause).__name__}: {one_line(cause)}")


def _end(ray: ModuleType, tasks: list[Any]) -> None:
    """End tasks as Ctrl-C ends a run, and give them time for it."""
    for task in tasks:
        ray.cancel(task)
    if tasks:
        ray.wait(tasks, num_returns=len(tasks), timeout=SECONDS_TO_END)
