"""Shared memory handed from process to process over their connections."""

from __future__ import annotations

from multiprocessing import reduction
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.shared_memory import SharedMemory

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from balloon_usd.batch.messages import Ring


def send_ring(connection: Connection[Any, Any], ring: Ring, memory: SharedMemory, process_id: int) -> None:
    """Tell a process of a ring and hand over its memory.

    Raises:
        BrokenPipeError: the process is gone.
        ConnectionResetError: the same.
    """
    connection.send(ring)
    if isinstance(memory.handle, int):
        reduction.send_handle(connection, memory.handle, process_id)


def receive_ring(connection: Connection[Any, Any], ring: Ring) -> SharedMemory:
    """Return the memory that follows a message about a ring."""
    if ring.name:
        return SharedMemory(ring.size, ring.name)
    return SharedMemory(ring.size, reduction.recv_handle(connection))
