"""The table at the end of a run says how near the walls came to bursting, and what is wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from balloon_usd.batch.order import Order
from balloon_usd.batch.record import Record, Status
from balloon_usd.cli.summary import print_summary
from balloon_usd.quality.measures import MEASURES

TOLD = {
    "fps": 24.0,
    "tails_left": {"main": 0.0},
    "highest_stretch": 7.4,
    "burst_stretch": 7.0,
    "burst_load": 0.71,
    "most_loaded": "head",
    "bursts": False,
}
EARLIER = {key: TOLD[key] for key in ("fps", "tails_left", "highest_stretch", "burst_stretch")} | {
    "bursts": True
}


@pytest.fixture
def printed(capsys):
    def print_it(told):
        record = Record("dog.yaml", "dog", Status.DONE, frames=48, summary=told)
        print_summary([record], Order(Path("out")), 1.0, "cpu")
        return capsys.readouterr().out

    return print_it


def test_a_wall_is_told_by_its_load_and_a_crease_beyond_seven_is_no_burst(printed):
    out = printed(TOLD)
    assert "7.4  71% of burst" in out
    assert "would burst" not in out


def test_what_would_burst_is_told_with_its_load_and_a_remedy(printed):
    out = printed(TOLD | {"bursts": True, "burst_load": 1.12})
    assert "dog: head would burst: its wall has 112% of the load at which latex tears: leave more tail" in out


def test_a_balloon_without_tail_is_told_with_its_hardest_bubble(printed):
    out = printed(TOLD | {"hard": {"main": ["right_hindleg", 9020.0]}})
    assert "dog: main has run out of tail: the hardest, right_hindleg, has 9.0 kPa: leave more tail" in out


def test_springs_have_no_load(printed):
    assert "of burst" not in printed(TOLD | {"burst_stretch": None, "burst_load": 0.0})


def test_what_an_earlier_version_has_made_is_listed_without_a_load(printed):
    assert "burst" not in printed(EARLIER)


def test_bubbles_whose_gas_is_off_the_plan_are_named_in_one_line(printed):
    told = [
        line
        for line in printed(TOLD | {"gas_off": {"nose": 0.03, "tail": 1.25}}).splitlines()
        if "gas" in line
    ]
    assert told == ["dog: not the gas of the plan: nose 3%, tail 125%: make them longer, or leave more tail"]


def test_no_gas_is_told_where_all_is_as_planned(printed):
    assert "gas" not in printed(TOLD | {"gas_off": {}})


def measured(**values):
    """A quality in which all but these measures are 0."""
    found = {key: measure.result(values.get(key, 0.0), {"worst": "a"}) for key, measure in MEASURES.items()}
    found["necks"] |= {"joint": "nose.end", "away": 0.05}
    found["joints"] |= {"held": 3, "meant": 3, "lost": []}
    return {"quality": {"off": [], **found}}


def test_a_figure_that_falls_over_is_told_with_a_remedy(printed):
    told = "dog: fell over, leaning 71 degrees: put its feet farther apart, or pose: hold"
    assert told in printed(TOLD | measured(lean=71.0))
    assert "fell over" not in printed(TOLD | measured(lean=14.0))


def test_a_wall_that_bursts_where_a_neck_is_drawn_in_has_another_remedy(printed):
    out = printed(TOLD | {"bursts": True, "burst_load": 30.0} | measured(necks=9.0))
    assert "rubber of the neck at nose.end is drawn in: longer bubbles there, or fewer" in out
    assert "leave more tail" not in out
