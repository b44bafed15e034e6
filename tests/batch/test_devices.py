"""Devices without memory and devices that are lost, on GPUs that are only pretended to be there."""

from __future__ import annotations

import pytest

from tests.batch import runs

ORDER = ("-o", "out", "--flat", "--no-preview", "--no-report")
NAMES = "abcdefgh"


def status(folder):
    return {name: (record["status"], record["device"]) for name, record in runs.records(folder).items()}


def test_a_device_out_of_memory_gets_smaller_batches(cli, solver, gpu, write_recipes, tmp_path):
    solver.trouble = {"a": "out of memory"}
    result = cli("run", write_recipes(*NAMES), *ORDER)
    assert result.exit_code == 0, result.output
    assert status(tmp_path / "out") == dict.fromkeys(NAMES, ("done", "cuda:0"))
    said = "cuda:0: Failed to allocate 123 bytes on device 'cuda:0'; going on with {} sculptures at a time"
    assert said.format(4) in result.stderr
    assert said.format(2) in result.stderr
    assert max(len(names) for names in solver.calls[1:]) <= 4


@pytest.mark.long
def test_the_cpu_takes_over_at_last_from_a_device_that_nobody_asked_for(
    cli, solver, gpu, write_recipes, tmp_path
):
    solver.trouble = dict.fromkeys(NAMES, "out of memory alone")
    result = cli("run", write_recipes(*NAMES), *ORDER)
    assert result.exit_code == 0, result.output
    assert status(tmp_path / "out") == dict.fromkeys(NAMES, ("done", "cpu"))
    assert "cuda:0: Failed to allocate 123 bytes on device 'cuda:0'; going on on the CPU" in result.stderr
    assert result.stderr.count("going on on the CPU") == 1


def test_recipes_of_a_device_that_was_asked_for_fail_with_it(cli, solver, gpu, write_recipes, tmp_path):
    solver.trouble = {"h": "device is lost"}
    result = cli("run", write_recipes(*NAMES), *ORDER, "--device", "cuda:0")
    assert result.exit_code == 3, result.output
    assert {told for told, _ in status(tmp_path / "out").values()} == {"device failed"}
    assert 'recipes/h.yaml: cuda:0: there is no device "cuda:0", only cpu' in result.stderr
    assert not [file for file in runs.tree(tmp_path / "out") if file != "batch.jsonl"]


@pytest.mark.long
def test_other_devices_take_over_from_one_that_is_lost(cli, solver, write_recipes, tmp_path, monkeypatch):
    monkeypatch.setenv("FAKE_GPUS", "cuda:0,cuda:1")
    solver.trouble = {"a": "first device is lost"}
    result = cli("run", write_recipes(*NAMES), *ORDER, "--device", "all")
    assert result.exit_code == 0, result.output
    assert set(status(tmp_path / "out").values()) <= {("done", "cuda:0"), ("done", "cuda:1")}
    assert "cuda:0: Warp CUDA error 719: unspecified launch failure; going on with 2" in result.stderr


def test_a_device_that_is_lost_mid_run_is_replaced_by_the_cpu(cli, solver, gpu, write_recipes, tmp_path):
    solver.trouble = {"a": "device is lost"}
    result = cli("run", write_recipes(*NAMES), *ORDER)
    assert result.exit_code == 0, result.output
    assert {told for told, _ in status(tmp_path / "out").values()} == {"done"}
    assert 'cuda:0: there is no device "cuda:0", only cpu; going on on the CPU' in result.stderr
    assert not [file for file in runs.tree(tmp_path / "out") if file.startswith(".")]
