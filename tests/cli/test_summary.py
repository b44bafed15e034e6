"""What the table at the end of a run warns of."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

from balloon_usd.batch.record import Record, Status
from balloon_usd.cli.summary import print_summary

SUMMARY = {"fps": 24.0, "tails_left": {"main": 0.02}, "highest_stretch": 5.7, "burst_stretch": 7.0}
ORDER = SimpleNamespace(folder=Path("out"), detail="draft")


def test_bubbles_whose_gas_is_off_the_plan_are_named_in_one_line(capsys):
    summary = SUMMARY | {"gas_off": {"nose": 0.03, "tail": 1.25}}
    print_summary([Record("a.yaml", "a", Status.DONE, summary=summary)], ORDER, 1.0, "cpu")
    told = [line for line in capsys.readouterr().out.splitlines() if "gas" in line]
    assert told == ["a: not the gas of the plan: nose 3%, tail 125%: make them longer, or leave more tail"]


def test_no_gas_is_told_where_all_is_as_planned(capsys):
    print_summary([Record("a.yaml", "a", Status.DONE, summary=SUMMARY | {"gas_off": {}})], ORDER, 1.0, "cpu")
    assert "gas" not in capsys.readouterr().out
