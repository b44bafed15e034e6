"""Chunks on a real Ray cluster of two machines, both of which are processes of this one."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import balloon_usd
from balloon_usd.batch.ray_cluster import ClusterError, import_ray
from balloon_usd.batch.ray_engine import make_on_cluster
from balloon_usd.batch.ray_machines import Needs

sys.path.insert(0, str(Path(__file__).parent))

from chunk_task import ChunkTask

HERE = Path(__file__).parent
ROOT = Path(balloon_usd.__file__).parents[1]

SMALL = {"num_cpus": 1, "object_store_memory": 80 << 20}
SOON_MISSED = {
    "health_check_initial_delay_ms": 0,
    "health_check_period_ms": 500,
    "health_check_timeout_ms": 500,
    "health_check_failure_threshold": 6,
}
"""A machine that says nothing for three seconds is lost; Ray waits half a minute."""
ONE_CPU = Needs(cpus=1)


@pytest.fixture(scope="module")
def interruptible():
    """Ctrl-C is heard, here and by workers, also where the tests run in the background of a shell: what is
    ignored when a process starts is ignored by all that it starts.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="module")
def cluster(interruptible):
    """A cluster of a head and one more machine with a GPU that nobody looks for, each with one CPU."""
    with pytest.MonkeyPatch.context() as patch:
        # Workers must find this folder and the code under test.
        patch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), str(HERE)]))
        import_ray()
        from ray.cluster_utils import Cluster  # noqa: PLC0415  # after its settings

        head = {**SMALL, "include_dashboard": False, "_system_config": SOON_MISSED}
        cluster = Cluster(initialize_head=True, head_node_args=head)
        cluster.add_node(**SMALL, num_gpus=1)
        yield cluster
        cluster.shutdown()


def chunks(count, length=2):
    return [[f"{chunk}{recipe}" for recipe in "abcdef"[:length]] for chunk in range(count)]


def names(count):
    return sorted(name for chunk in chunks(count) for name in chunk)


def made(folder):
    return sorted(path.stem for path in folder.glob("*.done"))


def begun_by(folder, name):
    """Wait for a recipe's first beginning and return its process."""
    for _ in range(600):
        try:
            return int((folder / f"{name}.begun").read_text().split()[0])
        except (FileNotFoundError, IndexError):
            time.sleep(0.05)
    raise TimeoutError(name)


def meanwhile(action):
    """Start an action beside the test."""
    thread = threading.Thread(target=action)
    thread.start()
    return thread


def lose_a_machine(cluster, folder):
    """Kill all processes of the machine that is not the head while it makes a recipe, as when the power goes."""
    (machine,) = cluster.worker_nodes
    raylet = machine.all_processes["raylet"][0].process.pid
    while not (busy := workers_of(raylet) & at_work(folder)):
        time.sleep(0.05)
    for pid in (raylet, *busy):
        os.kill(pid, signal.SIGKILL)
    cluster.remove_node(machine, allow_graceful=False)


def workers_of(raylet):
    found = subprocess.run(["pgrep", "-P", str(raylet)], capture_output=True, text=True, check=False)
    return {int(pid) for pid in found.stdout.split()}


def at_work(folder):
    """Return the processes that have begun a recipe and not made it."""
    begun = [file for file in folder.glob("*.begun") if not file.with_suffix(".done").exists()]
    return {int(pid) for file in begun for pid in file.read_text().split()}


def test_every_chunk_is_made_once_and_told_as_it_ends(cluster, tmp_path, capfd):
    ended = list(make_on_cluster(chunks(4), ChunkTask(tmp_path), ONE_CPU, tmp_path, cluster.address))
    assert sorted(each.chunk for each in ended) == [tuple(chunk) for chunk in chunks(4)]
    assert all([record["name"] for record in each.records] == list(each.chunk) for each in ended)
    assert made(tmp_path) == names(4)
    assert all(len(begun.read_text().split()) == 1 for begun in tmp_path.glob("*.begun"))
    assert capfd.readouterr() == ("", "")


def test_a_task_sees_the_gpu_that_it_needs(cluster, tmp_path):
    (ended,) = make_on_cluster([["a"]], ChunkTask(tmp_path), Needs(cpus=1, gpus=1), tmp_path, cluster.address)
    assert ended.records[0]["gpus"] == "0"


def test_a_task_for_which_no_machine_is_large_enough_is_refused_at_once(cluster, tmp_path):
    needs = r"a task needs 2 CPUs and 1 GPU, and no machine of the cluster has that \(they have 1 CPU; "
    with pytest.raises(ClusterError, match=needs):
        list(make_on_cluster(chunks(1), ChunkTask(tmp_path), Needs(2, 1), tmp_path, cluster.address))


def test_a_machine_that_does_not_share_the_folder_is_told_before_any_work(cluster, tmp_path, monkeypatch):
    monkeypatch.setattr("balloon_usd.batch.ray_machines.FILE_SECONDS", 0.2)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out").mkdir()
    # A relative path is another one wherever the current folder is another one, as it is in Ray's workers.
    with pytest.raises(ClusterError, match=r"^[^\n]*: out is not the folder of this name here, share it"):
        list(make_on_cluster(chunks(4), ChunkTask(tmp_path), ONE_CPU, Path("out"), cluster.address))
    assert [path.name for path in tmp_path.rglob("*")] == ["out"]


def test_a_machine_with_another_version_is_told_before_any_work(cluster, tmp_path, monkeypatch):
    monkeypatch.setattr("balloon_usd.batch.ray_machines.__version__", "9.0.0")
    with pytest.raises(ClusterError, match=r": balloon_usd is of version [\d.]+, expected 9.0.0 as here$"):
        list(make_on_cluster(chunks(4), ChunkTask(tmp_path), ONE_CPU, tmp_path, cluster.address))
    assert list(tmp_path.iterdir()) == []


def test_a_chunk_whose_worker_is_killed_begins_anew_where_it_was(cluster, tmp_path, capfd):
    killer = meanwhile(lambda: os.kill(begun_by(tmp_path, "0b"), signal.SIGKILL))
    ended = {
        each.chunk: each
        for each in make_on_cluster(chunks(3), ChunkTask(tmp_path, 0.4), ONE_CPU, tmp_path, cluster.address)
    }
    killer.join()
    assert made(tmp_path) == names(3)
    assert [record["status"] for record in ended["0a", "0b"].records] == ["skipped", "done"]
    assert len((tmp_path / "0a.begun").read_text().split()) == 1
    assert len((tmp_path / "0b.begun").read_text().split()) == 2
    assert capfd.readouterr() == ("", "")


def test_a_chunk_that_kills_every_worker_is_given_up_and_the_others_are_made(cluster, tmp_path, monkeypatch):
    monkeypatch.setattr("balloon_usd.batch.ray_engine.RETRIES", 1)
    task = ChunkTask(tmp_path, deadly="0b")
    ended = list(make_on_cluster(chunks(2), task, ONE_CPU, tmp_path, cluster.address))
    (lost,) = [each for each in ended if each.lost]
    assert lost.lost.startswith("WorkerCrashedError: The worker died")
    assert (lost.chunk, lost.records) == (("0a", "0b"), [])
    assert made(tmp_path) == ["0a", "1a", "1b"]
    assert len((tmp_path / "0b.begun").read_text().split()) == 2


@pytest.mark.parametrize(("error", "lost"), [(OSError, None), (ValueError, "ValueError: a was lost")])
def test_only_what_may_be_found_again_is_tried_again(cluster, tmp_path, error, lost):
    (ended,) = make_on_cluster([["a"]], ChunkTask(tmp_path, error=error), ONE_CPU, tmp_path, cluster.address)
    assert ended.lost == lost
    assert made(tmp_path) == ([] if lost else ["a"])


def test_tasks_end_as_by_hand_when_nobody_waits_for_them(cluster, tmp_path):
    def interrupt():
        begun_by(tmp_path, "a")
        begun_by(tmp_path, "b")
        os.kill(os.getpid(), signal.SIGINT)

    by_hand = meanwhile(interrupt)
    with pytest.raises(KeyboardInterrupt):
        list(
            make_on_cluster(
                [["a"], ["b"], ["c"]], ChunkTask(tmp_path, 30.0), ONE_CPU, tmp_path, cluster.address
            )
        )
    by_hand.join()
    assert sorted(path.name for path in tmp_path.glob("*.interrupted")) == ["a.interrupted", "b.interrupted"]
    assert not (tmp_path / "c.begun").exists()


def test_what_a_lost_machine_was_making_is_made_by_the_others(cluster, tmp_path, capfd):
    killer = meanwhile(lambda: lose_a_machine(cluster, tmp_path))
    ended = list(make_on_cluster(chunks(4), ChunkTask(tmp_path, 0.5), ONE_CPU, tmp_path, cluster.address))
    killer.join()
    assert [each.lost for each in ended] == [None] * 4
    assert made(tmp_path) == names(4)
    assert max(len(begun.read_text().split()) for begun in tmp_path.glob("*.begun")) == 2
    assert capfd.readouterr() == ("", "")


@pytest.mark.long
def test_a_batch_outlives_five_machines(cluster, tmp_path):
    for machine in [*cluster.worker_nodes]:
        cluster.remove_node(machine)
    lost, killers = [], []
    for ended in make_on_cluster(chunks(60), ChunkTask(tmp_path, 0.5), ONE_CPU, tmp_path, cluster.address):
        lost.append(ended.lost)
        if not cluster.worker_nodes and len(killers) < 5:
            cluster.add_node(**SMALL)
            killers.append(meanwhile(lambda: lose_a_machine(cluster, tmp_path)))
    assert len(killers) == 5
    assert lost == [None] * 60
    assert made(tmp_path) == names(60)
    assert sum(len(begun.read_text().split()) for begun in tmp_path.glob("*.begun")) == 120 + 5


ON_THIS_MACHINE = """
import sys
from pathlib import Path
from chunk_task import ChunkTask
from balloon_usd.batch.ray_engine import make_on_cluster
from balloon_usd.batch.ray_machines import Needs

folder = Path(sys.argv[1])
for ended in make_on_cluster([["a"], ["b"]], ChunkTask(folder), Needs(cpus=1), folder):
    print(*ended.chunk, ended.records[0]["status"])
"""


def test_without_an_address_a_cluster_of_this_machine_is_started_and_nothing_more_is_said(tmp_path):
    path = os.pathsep.join([str(ROOT), str(HERE)])
    environment = {**os.environ, "PYTHONPATH": path, "HOME": str(tmp_path)}
    command = [sys.executable, "-c", ON_THIS_MACHINE, str(tmp_path)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(done.stdout.splitlines()) == ["a done", "b done"]
