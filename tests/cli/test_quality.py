"""The quality in what a run prints and leaves."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from pxr import Sdf

from balloon_usd.batch.order import Order
from balloon_usd.batch.record import Record, Status
from balloon_usd.cli.summary import WORST, print_summary
from balloon_usd.quality.measures import MEASURES


def records():
    """The lines of `batch.jsonl` as dictionaries."""
    return [json.loads(line) for line in Path("out/batch.jsonl").read_text("utf-8").splitlines()]


def figure(name, **values):
    """The record of a figure that was made, with measures of these values; all others are 0."""
    found = {
        key: measure.result(values.get(key, 0.0), {"worst": "neck"}) for key, measure in MEASURES.items()
    }
    found["joints"] |= {"held": 3, "meant": 3, "lost": []}
    found["crossings"] |= {"bubbles": [{"pair": ["nose", "tail"], "count": 1}]}
    off = [key for key, result in found.items() if result["verdict"] == "off"]
    told = {"fps": 24.0, "tails_left": {}, "highest_stretch": 5.0, "burst_stretch": 7.0}
    quality = {"verdict": "off" if off else "good", "off": off, **found}
    return Record(f"{name}.yaml", name, Status.DONE, frames=10, summary={**told, "quality": quality})


@pytest.fixture
def printed(capsys):
    """Return the lines that tell of the quality of some figures."""

    def lines(*figures):
        print_summary(figures, Order(Path("out"), "draft"), 1.0, "cpu")
        return [
            line for line in capsys.readouterr().out.splitlines() if "quality" in line or "figures" in line
        ]

    return lines


def test_the_report_and_the_journal_have_the_same_quality_and_the_summary_a_line(cli, solver, write_recipe):
    result = cli("run", write_recipe(), "-o", "out", "--device", "cpu", "--no-preview")
    assert result.exit_code == 0, result.output
    (record,) = records()
    quality = record["summary"]["quality"]
    assert set(MEASURES) < set(quality)
    assert json.loads(Path("out/snake.report.json").read_text("utf-8"))["quality"] == quality
    assert result.stdout.count("quality: gas ") == 1


def test_the_stage_carries_its_crossings_and_the_report_those_of_every_frame_counted(
    cli, solver, write_recipe
):
    solver.trouble = {"snake": "fold"}
    result = cli("run", write_recipe(), "-o", "out", "--device", "cpu", "--no-preview", "--flat")
    assert result.exit_code == 0, result.output
    facts = Sdf.Layer.FindOrOpen("out/snake.usdc").customLayerData["balloon_usd"]
    rows = json.loads(Path("out/snake.report.json").read_text("utf-8"))["crossings"]
    found = records()[0]["summary"]["quality"]["crossings"]
    assert found["value"] > 20
    assert facts["crossings"] == found["value"] == rows["count"][-1]
    assert f", {found['value']} crossings (" in result.stdout
    assert found["most"] == max(rows["count"])
    assert rows["time_code"][rows["count"].index(found["most"])] == found["most_at"]


def test_a_run_without_a_report_has_its_quality_too(cli, solver, write_recipe):
    cli("run", write_recipe(), "-o", "out", "--no-preview", "--no-report")
    assert records()[0]["summary"]["quality"]["verdict"] in ("good", "off")


def test_a_run_that_ends_before_the_last_frame_has_no_quality(cli, solver, write_recipe):
    result = cli("run", write_recipe(), "-o", "out", "--no-preview", "--frames", ":3")
    assert result.exit_code == 0, result.output
    assert records()[0]["summary"]["quality"] is None
    assert "quality" not in result.stdout


def test_the_worst_figures_of_a_batch_are_told_first_and_good_ones_not_at_all(printed):
    lines = printed(figure("good"), figure("gas", gas=0.3), figure("both", gas=0.2, crossings=2, depth=0.001))
    assert [line.split(":")[0] for line in lines] == ["quality of both", "quality of gas"]
    assert "2 crossings (nose and tail, 1.0 mm)" in lines[0]
    assert lines[1].startswith("quality of gas: gas 30.0 % off (neck)")


def test_most_crossings_are_told_where_there_were_more_than_in_the_end(printed):
    def line(value, most):
        record = figure("dog", crossings=value, depth=0.001)
        record.summary["quality"]["crossings"] |= {"most": most, "most_at": 313}
        return next(iter(printed(record)))

    assert "held, 0 crossings (12 in frame 313), " in line(0, 12)
    assert "held, 2 crossings (nose and tail, 1.0 mm, 12 in frame 313), " in line(2, 12)
    assert "held, 2 crossings (nose and tail, 1.0 mm), " in line(2, 2)


def test_a_large_batch_tells_of_a_few_and_counts_the_others(printed):
    lines = printed(*(figure(f"figure_{k}", gas=0.2 + 0.01 * k) for k in range(WORST + 3)), figure("good"))
    assert len(lines) == WORST + 1
    assert lines[0].startswith(f"quality of figure_{WORST + 2}:")
    assert lines[-1] == f"3 more of {WORST + 4} figures are off"
