"""Reports: the numbers of a run, their file, and the figure."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageChops

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.quality.crossing_history import CrossingHistory
from balloon_usd.quality.pierced_walls import Crossings
from balloon_usd.recipe import Recipe
from balloon_usd.report import History, ReportError, draw_figure, report_data, report_text, write_report
from balloon_usd.report.figure import panels_of
from balloon_usd.report.step_marks import step_marks
from balloon_usd.solver.frame import Frame

PAGE = Path(__file__).parents[2] / "docs/reference/report.md"
TUBE = """\
format: 1
name: snake
title: A snake
units: cm
balloons:
  main: {size: 260, length: 16, tail: 5}
steps:
  - bubbles: {nose: 8, middle: 10}
  - lock: [nose, middle]
  - rest: tail
  - bend: {tail: 60}
  - wait: 1.5
"""
CAPSULE = """\
format: 1
name: air
units: cm
balloons:
  main: {size: 260, capsule: 20}
steps:
  - press: {bubble: main_rest, depth: 1}
physics: {model: kosaka}
"""
UNDONE, UNDONE_FROM = ("nose.end",), 30
"""What comes undone in the frames below, and from which frame on."""
ORIGIN = {"recipe": "snake.yaml", "recipe_sha256": "0" * 64, "solver": "latex 1"}


def flat(text=TUBE):
    """A plan and its meshes."""
    plan = plan_of(Recipe.parse(text, file="snake.yaml"))
    return plan, [mesh_of(strip, detail_named("draft")) for strip in plan.strips.values()]


def frame(plan, meshes, code, wide=1.0):
    """A frame of flat balloons, `wide` times as wide."""
    bubbles = np.arange(1, len(plan.bubbles) + 1, dtype=np.float32)
    return Frame(
        code,
        tuple(mesh.points * np.float32([1, wide, wide]) for mesh in meshes),
        tuple(mesh.along + np.float32(2.0) for mesh in meshes),
        1000.06 * bubbles,
        1e-4 * bubbles,
        "hold",
        contact=0.5 * bubbles if plan.recipe.physics.model == "latex" else None,
        undone=UNDONE if code >= UNDONE_FROM else (),
    )


def history_of(codes, text=TUBE):
    plan, meshes = flat(text)
    history = History(plan, meshes)
    for code in codes:
        history.add(frame(plan, meshes, code))
    return history


@pytest.fixture
def history():
    return history_of(range(1, 200))


def test_every_bubble_has_a_column_in_plan_order(history):
    assert history.bubble_names == ("nose", "middle", "tail")
    assert history.pressure.shape == history.volume.shape == history.stretch.shape == (199, 3)
    assert history.pressure[7] == pytest.approx([1000.06, 2000.12, 3000.18])


def test_the_highest_stretch_is_that_of_the_bubbles_own_wall(history):
    ends = [bubble.rest_end for bubble in history.plan.bubbles]
    assert history.stretch[0, 0] == pytest.approx(2.0 + ends[0], abs=2e-4)
    assert history.stretch[0, 1] == pytest.approx(2.0 + ends[1], abs=2e-4)
    assert (np.diff(history.stretch[0]) > 0).all()


def tails_of(codes, wider, undone=()):
    """Flat tails of a tube whose bubbles hold so many times what they do when flat."""
    plan, meshes = flat()
    history = History(plan, meshes)
    volume = wider * np.pi * 0.0042**2 * np.array([bubble.rest_length for bubble in plan.bubbles])
    for code in codes:
        history.add(replace(frame(plan, meshes, code), volume=volume, undone=undone))
    assert history.tail_names == ("main",)
    return history.tail[:, 0]


def pinched():
    """The first frame in which the first neck is closed."""
    return 2 + round(24 * next(m.end for m in flat()[0].choreography.moves if "pinch" in m.text))


def test_a_flat_balloon_is_all_tail_until_a_neck_closes():
    before, after = tails_of([1, pinched()], 1.0)
    assert before == pytest.approx(0.16, abs=0.001)
    assert after == pytest.approx(0.16 - flat()[0].bubbles[0].rest_end, abs=0.001)


def test_a_neck_that_has_come_undone_parts_nothing():
    assert tails_of([pinched()], 1.0, ("nose.end",)) == pytest.approx([0.16], abs=0.001)


def test_a_balloon_that_is_blown_up_has_no_tail():
    assert tails_of([1, pinched()], 200.0) == pytest.approx([0.0, 0.0])


def test_a_capsule_has_no_tail():
    history = history_of(range(1, 4), CAPSULE)
    assert history.tail_names == ()
    data = report_data(history, detail="draft", provenance=ORIGIN)
    assert data["balloons"] == []
    assert data["burst_stretch"] is None


def test_steps_are_marked_where_they_begin_by_what_they_do():
    texts = [mark.text for mark in step_marks(flat()[0])]
    assert texts == [
        "inflate: main",
        "bubbles: nose, middle",
        "lock: nose, middle",
        "bend: tail",
        "wait: 1.5 s",
        "loosen the grip",
        "hold",
    ]
    codes = [mark.time_code for mark in step_marks(flat()[0])]
    assert codes == sorted(set(codes))
    assert codes[0] == 1


def test_a_push_is_marked_by_its_bubble():
    assert [mark.text for mark in step_marks(flat(CAPSULE)[0])][1] == "press: main_rest"


def test_a_range_of_frames_has_the_steps_that_are_seen_in_it():
    marks = step_marks(flat()[0])
    history = history_of(range(marks[1].time_code + 3, marks[2].time_code + 3))
    assert history.marks == marks[1:3]


def test_the_document_has_its_keys_in_order_and_units_for_its_numbers(history):
    data = json.loads(report_text(report_data(history, detail="draft", provenance=ORIGIN)))
    assert list(data) == [
        "format",
        "name",
        "title",
        "recipe",
        "recipe_sha256",
        "solver",
        "model",
        "detail",
        "fps",
        "units",
        "burst_stretch",
        "steps",
        "undone",
        "failed",
        "quality",
        "crossings",
        "time_code",
        "time",
        "bubbles",
        "balloons",
    ]
    assert data["format"] == 1
    assert list(data["bubbles"][0]) == ["name", "balloon", "pressure", "volume", "stretch", "contact"]
    assert {*data["units"]} == {"time", "pressure", "volume", "stretch", "contact", "tail"}
    assert len(data["time"]) == len(data["bubbles"][2]["volume"]) == len(data["balloons"][0]["tail"]) == 199
    assert data["time"][24] == 1.0


def test_every_key_of_the_document_is_explained(history):
    data = report_data(history, detail="draft", provenance=ORIGIN)
    page = re.sub(r"<!-- generated: .*?<!-- end", "", PAGE.read_text("utf-8"), flags=re.DOTALL)
    rows = [row.split("|")[1] for row in page.splitlines() if row.startswith("| `")]
    assert sorted(re.findall(r"`(\w+)`", " ".join(rows))) == sorted(data)


def test_the_quality_is_told_as_it_was_measured_and_null_where_it_was_not(history):
    assert report_data(history, detail="draft", provenance=ORIGIN)["quality"] is None
    quality = {"verdict": "good", "off": [], "speed": {"value": 0.001}}
    data = report_data(history, detail="draft", provenance=ORIGIN, quality=quality)
    assert json.loads(report_text(data))["quality"] == quality


def crossed():
    """A history in which two bubbles cross, one crosses itself, and nothing does in the end."""
    crossings = CrossingHistory()
    crossings.add(1, Crossings(0, 3, {}))
    crossings.add(13, Crossings(9, 4, {("nose", "tail"): 7, ("nose", "nose"): 2}))
    crossings.add(20, Crossings(0, 5, {}))
    history = History(*flat(), crossings)
    for code in range(1, 21):
        history.add(frame(history.plan, flat()[1], code))
    return history


def test_crossings_are_told_for_every_frame_in_which_they_were_counted_and_null_where_they_were_not(history):
    assert report_data(history, detail="draft", provenance=ORIGIN)["crossings"] is None
    data = json.loads(report_text(report_data(crossed(), detail="draft", provenance=ORIGIN)))
    assert data["crossings"] == {
        "time_code": [1, 13, 20],
        "count": [0, 9, 0],
        "in_necks": [3, 4, 5],
        "bubbles": [
            {"pair": ["nose", "tail"], "count": [0, 7, 0]},
            {"pair": ["nose", "nose"], "count": [0, 2, 0]},
        ],
    }


def test_the_figure_has_a_curve_of_all_crossings_and_of_the_worst_pairs_by_name(history):
    assert "Crossings" not in [panel.title for panel in panels_of(history)]
    panel = panels_of(crossed())[-1]
    assert panel.title == "Crossings"
    assert [curve.name for curve in panel.curves] == ["all", "nose and tail", "nose with itself"]
    assert [curve.values.tolist() for curve in panel.curves] == [[0, 9, 0], [0, 7, 0], [0, 2, 0]]
    assert panel.times.tolist() == [0.0, 0.5, 19 / 24]
    assert draw_figure(crossed(), detail="draft").height > draw_figure(history, detail="draft").height


def test_numbers_are_rounded_to_what_single_precision_means(history):
    bubble = report_data(history, detail="draft", provenance=ORIGIN)["bubbles"][2]
    assert bubble["pressure"][0] == 3000.2
    assert bubble["volume"][0] == 0.0003


def test_what_comes_undone_is_told_with_its_moment(history):
    data = report_data(history, detail="draft", provenance=ORIGIN)
    assert data["undone"] == [{"joint": "nose.end", "time_code": 30, "time": round(29 / 24, 6)}]
    assert [step["text"] for step in data["steps"]] == [mark.text for mark in history.marks]


def test_a_failure_is_told_with_its_cause_and_the_last_frame_before_it(history):
    assert report_data(history, detail="draft", provenance=ORIGIN)["failed"] is None
    data = report_data(history, detail="draft", provenance=ORIGIN, failed="at 8.3 s: torn")
    assert data["failed"] == {"cause": "at 8.3 s: torn", "last_good_frame": 199, "time": 8.25}


def test_the_figure_writes_a_failure_below_and_cuts_what_is_too_long_for_a_line(history):
    plain = draw_figure(history, detail="draft")
    failed = draw_figure(history, detail="draft", failed="at 8.3 s: torn" + 300 * " and torn")
    assert failed.size == plain.size
    difference = ImageChops.difference(failed, plain).getbbox()
    assert difference is not None
    left, top, right, bottom = difference
    assert top > plain.height - 40
    assert bottom < plain.height
    assert 20 < left < right < plain.width - 20


def test_the_figure_marks_what_comes_undone_between_the_steps(history):
    texts = [mark.text for mark in history.events]
    assert texts.index("comes undone: nose.end") == 1
    assert len(texts) == 1 + len(history.marks)


def test_the_contact_of_every_bubble_is_told_and_drawn(history):
    data = report_data(history, detail="draft", provenance=ORIGIN)
    assert [bubble["contact"][7] for bubble in data["bubbles"]] == [0.5, 1.0, 1.5]
    assert [panel.title for panel in panels_of(history)].count("Contact") == 1


def test_a_model_whose_walls_are_moved_apart_without_a_force_has_no_contact():
    history = history_of(range(1, 4), CAPSULE)
    data = report_data(history, detail="draft", provenance=ORIGIN)
    assert "contact" not in data["bubbles"][0]
    assert all(panel.title != "Contact" for panel in panels_of(history))


def test_a_negative_zero_is_written_as_zero():
    plan, meshes = flat()
    history = History(plan, meshes)
    one = frame(plan, meshes, 1)
    one.pressure[:] = -0.01
    history.add(one)
    assert "-0.0" not in report_text(report_data(history, detail="draft", provenance=ORIGIN))


def test_frames_may_change_after_they_were_taken_in():
    plan, meshes = flat()
    history = History(plan, meshes)
    one = frame(plan, meshes, 1)
    history.add(one)
    for array in (one.pressure, one.volume, *one.stretch, *one.points):
        array[:] = 0
    assert history.pressure[0, 0] == pytest.approx(1000.06)


def test_a_row_of_numbers_stays_on_one_line(history):
    lines = report_text(report_data(history, detail="draft", provenance=ORIGIN)).splitlines()
    assert len(lines) <= 60
    assert sum("pressure" in line for line in lines) == 1 + 3


def test_equal_frames_give_equal_bytes(history, tmp_path):
    (tmp_path / "again").mkdir()
    first = write_report(history, tmp_path, detail="draft", provenance=ORIGIN)
    again = write_report(history_of(range(1, 200)), tmp_path / "again", detail="draft", provenance=ORIGIN)
    assert [file.name for file in first] == ["snake.report.json", "snake.report.png"]
    assert [file.read_bytes() for file in first] == [file.read_bytes() for file in again]


def test_a_report_that_cannot_be_written_leaves_nothing(history, tmp_path):
    (tmp_path / "snake.report.json").mkdir()
    with pytest.raises(ReportError, match=r"snake\.report\.json cannot be written"):
        write_report(history, tmp_path, detail="draft", provenance=ORIGIN)
    assert [path.name for path in tmp_path.iterdir()] == ["snake.report.json"]


def test_a_full_disk_leaves_the_report_that_was_there(history, tmp_path, monkeypatch):
    before = write_report(history, tmp_path, detail="draft", provenance=ORIGIN)[0].read_bytes()

    def full(path, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(ReportError, match="No space left on device"):
        write_report(history, tmp_path, detail="full", provenance=ORIGIN)
    assert (tmp_path / "snake.report.json").read_bytes() == before
    assert len(list(tmp_path.iterdir())) == 2


def test_without_frames_there_is_nothing_to_report(tmp_path):
    with pytest.raises(ReportError, match="no frame was seen"):
        write_report(history_of([]), tmp_path, detail="draft", provenance=ORIGIN)


@pytest.mark.parametrize("codes", [[5], [5, 6], range(1, 150)])
@pytest.mark.parametrize("text", [TUBE, CAPSULE])
def test_any_number_of_frames_is_drawn(codes, text):
    picture = draw_figure(history_of(codes, text), detail="draft")
    assert isinstance(picture, Image.Image)
    assert picture.width > 1500
    assert len({color for _, color in picture.getcolors(1 << 24)}) > 50


def test_numbers_beyond_measure_are_drawn_too():
    plan, meshes = flat()
    history = History(plan, meshes)
    for code, value in enumerate((0.0, -3e4, 1e9), start=1):
        one = frame(plan, meshes, code)
        one.pressure[:] = value
        one.volume[:] = 0.0
        history.add(one)
    assert draw_figure(history, detail="draft").height > 500
