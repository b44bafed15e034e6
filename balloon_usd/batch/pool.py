"""The worker processes of a batch: started, found dead, replaced, and brought to their end."""

from __future__ import annotations

import time
from multiprocessing.connection import wait
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.messages import Role, Start
from balloon_usd.batch.worker_process import Worker

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.batch.order import Order

GRACE = 8.0
"""Time for all workers to tidy up before they are killed (s)."""


class Pool:
    """All workers that live."""

    def __init__(self, order: Order) -> None:
        """Begin with none."""
        self._order = order
        self._workers: dict[Any, Worker] = {}
        self._dismissed: list[Worker] = []
        """Workers that end in their own time."""

    def start(self, role: Role, device: str = "", *, fork: bool = False) -> Worker:
        """Start a worker; raises `OSError` when the system has no room for one."""
        worker = Worker(role, device, fork=fork)
        self._workers[worker.connection] = worker
        worker.send(Start(role, self._order, device))
        return worker

    def of(self, role: Role) -> list[Worker]:
        """Return the workers of a role, those that start included."""
        return [worker for worker in self._workers.values() if worker.role is role]

    def heard(self) -> Iterator[tuple[Worker, object | None]]:
        """Wait, then yield a message of every worker that has one; None of a worker that is gone."""
        for connection in wait(list(self._workers)):
            worker = self._workers.get(connection)
            if worker is None:
                continue
            try:
                message: object | None = worker.connection.recv()
            except (EOFError, OSError):
                # Also in the middle of a message.
                message = None
                self.remove(worker)
            yield worker, message

    def remove(self, worker: Worker) -> None:
        """Close the connection to a worker, which ends it if it lives."""
        if self._workers.pop(worker.connection, None) is not None:
            self._dismissed.append(worker)
        worker.close()

    def close(self) -> bool:
        """End all workers; return whether all of them tidied up."""
        for worker in list(self._workers.values()):
            worker.end()
            self.remove(worker)
        deadline = time.monotonic() + GRACE
        tidy = True
        for worker in self._dismissed:
            if not worker.wait(max(0.0, deadline - time.monotonic())):
                worker.kill()
                tidy = False
        return tidy
