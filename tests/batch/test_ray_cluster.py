from __future__ import annotations

import socket
import sys
import threading
import time
from contextlib import contextmanager

import pytest

from balloon_usd.batch.ray_cluster import ClusterError, ray_cluster


@contextmanager
def refused(words):
    """What happens in the block is refused in one line with these words, long before Ray would give up."""
    begin = time.monotonic()
    with pytest.raises(ClusterError) as raised:
        yield
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)
    assert time.monotonic() - begin < 6


@pytest.fixture
def listener():
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server


def address(server):
    return f"127.0.0.1:{server.getsockname()[1]}"


@pytest.mark.parametrize(
    "text", ["nonsense", "ray://127.0.0.1:10001", "127.0.0.1", "auto", "a b:6379", "127.0.0.1:123456"]
)
def test_what_is_no_address_is_told(text):
    with refused(f"{text}: no address of a cluster, expected HOST:PORT"), ray_cluster(text):
        pass


def test_an_address_where_nobody_listens_is_told(listener):
    nobody = address(listener)
    listener.close()
    with refused(f"{nobody}: no Ray cluster answers (Connection refused)"), ray_cluster(nobody):
        pass


def test_a_port_that_is_none_is_told():
    with refused("127.0.0.1:70000: no Ray cluster answers"), ray_cluster("127.0.0.1:70000"):
        pass


def test_a_machine_that_nobody_knows_is_told():
    with refused("nobody.invalid:6379: no Ray cluster answers"), ray_cluster("nobody.invalid:6379"):
        pass


def test_one_who_listens_and_says_nothing_is_told(listener):
    with refused(f"{address(listener)}: no Ray cluster answers (timed out)"), ray_cluster(address(listener)):
        pass


def test_one_who_speaks_otherwise_is_told(listener):
    def answer():
        connection, _ = listener.accept()
        with connection:
            connection.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")
            connection.recv(1000)

    threading.Thread(target=answer).start()
    with refused(f"{address(listener)}: what answers is no Ray cluster"), ray_cluster(address(listener)):
        pass


def test_without_ray_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    with refused("Ray is not installed: pip install 'balloon-usd[cluster]'"), ray_cluster(None):
        pass
