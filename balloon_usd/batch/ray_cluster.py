"""A Ray cluster: reached at its address, or started on this machine."""

from __future__ import annotations

import logging
import os
import re
import socket
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

ANSWER_SECONDS = 3.0
"""Time in which a cluster must answer, s; Ray itself asks for minutes."""
STORE_BYTES = 80 << 20
"""Memory for Ray's objects on this machine: records are small, and frames never pass through it."""
SETTINGS_OF_RAY = {
    "RAY_USAGE_STATS_ENABLED": "0",
    # Ray would otherwise make the environment anew on every machine when it is started by `uv run`.
    "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0",
    # What Ray says of lost workers and machines would go to the standard output.
    "RAY_DEDUP_LOGS_SKIP_REGEX": ".*",
}
GREETING = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + bytes([0, 0, 0, 4, 0, 0, 0, 0, 0])
"""How HTTP/2 begins, which Ray speaks: a preface, then settings, of which there are none."""
TYPE_OF_FRAME = slice(3, 4)
BEGIN = b"\x04"
"""Type of the frame with which the other side begins."""


class ClusterError(Exception):
    """A cluster cannot be used as asked; the message has one line a problem."""


@contextmanager
def ray_cluster(address: str | None) -> Iterator[ModuleType]:
    """Connect to a Ray cluster and hand out the module `ray`.

    Args:
        address: HOST:PORT of a cluster of which this machine is a part; None starts one here that ends with
            the block.

    Raises:
        ClusterError: Ray is not installed, nobody answers at the address, or Ray refuses.
    """
    ray = import_ray()
    if address is not None:
        require_ray_at(address)
    here = {} if address is not None else {"object_store_memory": STORE_BYTES}
    try:
        ray.init(
            address=address or "local",
            include_dashboard=False,
            logging_level=logging.ERROR,
            log_to_driver=False,
            **here,
        )
    except (OSError, RuntimeError, ValueError, ray.exceptions.RayError) as error:
        raise ClusterError(f"{address or 'Ray'}: {one_line(error)}") from error
    try:
        yield ray
    finally:
        ray.shutdown()


def one_line(error: BaseException) -> str:
    """Return what an error says in one line; of a traceback in it, what it ends with."""
    text = str(error).strip()
    if "Traceback (most recent call last)" in text:
        text = text.splitlines()[-1]
    return " ".join(text.split()) or type(error).__name__


def import_ray() -> ModuleType:
    """Import Ray with the settings that it reads only then.

    Raises:
        ClusterError: Ray is not installed.
    """
    for name, value in SETTINGS_OF_RAY.items():
        os.environ.setdefault(name, value)
    try:
        import ray  # noqa: PLC0415
    except ImportError as error:
        raise ClusterError("Ray is not installed: pip install 'balloon-usd[cluster]'") from error
    return ray


def require_ray_at(address: str) -> None:
    """Check that something at the address answers as Ray does.

    Raises:
        ClusterError: nothing does, or the address is none.
    """
    match = re.fullmatch(r"\[?([^\s/\[\]]+?)\]?:(\d{1,5})", address, re.ASCII)
    if not match:
        raise ClusterError(f"{address}: no address of a cluster, expected HOST:PORT, such as 127.0.0.1:6379")
    try:
        answer = _answer(match[1], int(match[2]))
    except (OSError, OverflowError) as error:
        why = getattr(error, "strerror", None) or error
        raise ClusterError(f"{address}: no Ray cluster answers ({why})") from error
    if answer[TYPE_OF_FRAME] != BEGIN and os.environ.get("RAY_USE_TLS", "0").lower() not in {"1", "true"}:
        raise ClusterError(f"{address}: what answers is no Ray cluster")


def _answer(host: str, port: int) -> bytes:
    """Greet, and return the first bytes of the answer."""
    with socket.create_connection((host, port), ANSWER_SECONDS) as connection:
        connection.sendall(GREETING)
        return connection.recv(TYPE_OF_FRAME.stop)
