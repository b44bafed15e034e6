"""Whole runs on a Ray cluster of two machines, which are lost one after another."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from contextlib import suppress
from pathlib import Path

import pytest

from balloon_usd.batch.ray_cluster import import_ray
from tests.batch import runs
from tests.batch.conftest import write_recipes_into
from tests.batch.test_ray_engine import SMALL, SOON_MISSED
from tests.command_line import FAKE, pretend_solver

FORM = ("--no-preview", "--device", "cpu")


@pytest.fixture
def cluster(tmp_path_factory, monkeypatch):
    """A cluster of a head and one more machine with a CPU each, where nobody simulates physics."""
    import_ray()
    from ray.cluster_utils import Cluster  # noqa: PLC0415  # after its settings

    # Ray puts folders of its own on the path, and these tests theirs before them.
    pretend_solver(monkeypatch, tmp_path_factory.mktemp("solver"))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(FAKE), str(runs.ROOT)]))
    head = {**SMALL, "include_dashboard": False, "_system_config": SOON_MISSED}
    cluster = Cluster(initialize_head=True, head_node_args=head)
    cluster.add_node(**SMALL)
    yield cluster
    cluster.shutdown()


def below(pid):
    """Return the processes that a process has started, and those that these have."""
    found = subprocess.run(["pgrep", "-P", str(pid)], capture_output=True, text=True, check=False)
    children = [int(child) for child in found.stdout.split()]
    return [*children, *(pid for child in children for pid in below(child))]


def simulates(pid):
    """Whether a process works for a batch."""
    with suppress(OSError):
        return runs.WORKER in Path(f"/proc/{pid}/cmdline").read_text()
    return False


def lose_a_machine(cluster, run):
    """Kill all processes of the machine that is not the head while it makes a recipe, as when the power goes."""
    (machine,) = cluster.worker_nodes
    raylet = machine.all_processes["raylet"][0].process.pid
    while not any(map(simulates, all_of_it := below(raylet))):
        assert run.poll() is None, "the run was over too soon"
        time.sleep(0.05)
    for pid in (raylet, *all_of_it):
        runs.kill(pid)
    cluster.remove_node(machine, allow_graceful=False)


@pytest.mark.long
@pytest.mark.parametrize("machines", [1, 5])
def test_a_run_outlives_the_machines_that_it_loses(machines, cluster, tmp_path):
    recipes = write_recipes_into(tmp_path / "recipes", [f"s{number:02}" for number in range(6 * machines)])
    assert runs.run(recipes, "-o", "here", *FORM, cwd=tmp_path)[0] == 0
    words = (recipes, "-o", "there", *FORM, "--engine", "ray", "--address", cluster.address)
    run = runs.start(*words, cwd=tmp_path)
    try:
        for number in range(machines):
            if number:
                cluster.add_node(**SMALL)
            lose_a_machine(cluster, run)
        told = run.communicate(timeout=runs.PATIENCE)[1]
    finally:
        if run.poll() is None:
            run.send_signal(signal.SIGTERM)
            run.communicate()
    assert run.returncode == 0, told
    assert runs.tree(tmp_path / "there") == runs.tree(tmp_path / "here")
