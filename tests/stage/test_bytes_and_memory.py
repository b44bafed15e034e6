from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from balloon_usd.stage import write_stage
from balloon_usd.stage.properties import same_bytes
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    import subprocess
    from pathlib import Path

Child = Callable[..., "subprocess.Popen[str]"]

BIG_RUN = """
rings, count = 1250, int(os.environ["COUNT"])
one, other = tube_points(rings, 0.0), tube_points(rings, 1.0)
per_bubble, per_vertex = np.ones(5, np.float32), np.ones(len(one), np.float32)
def moving():
    for t in range(1, count + 1):
        shift = np.float32(1e-4 * t)
        stretch = per_vertex + shift
        yield Frame(t, (one + shift, other + shift), (stretch, stretch), per_bubble, per_bubble)
write_stage(sculpture(rings), moving(), os.environ["OUT"])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""


FORMS = """
for name, choices in {"layers": {"shot": True}, "flat": {"flat": True}, "usdz": {"usdz": True},
                      "stress": {"usdz": True, "look": "stress"}}.items():
    write_stage(sculpture(), frames(30), Path(os.environ["OUT"], name), **choices)
"""


def test_two_runs_give_the_same_bytes_in_every_form(tmp_path: Path, child: Child) -> None:
    """In another process, with another order of hashes and in another time zone."""
    for place, seed, zone in (("here", "0", "UTC"), ("there", "1", "Asia/Tokyo"), ("west", "2", "HST10")):
        there = tmp_path / place
        process = child(FORMS, OUT=str(there), PYTHONHASHSEED=seed, TZ=zone)
        _, errors = process.communicate()
        assert process.returncode == 0, errors
        assert sorted(folder.name for folder in there.iterdir()) == ["flat", "layers", "stress", "usdz"]
        assert list(same_bytes(tmp_path / "here", there)) == []


@pytest.mark.parametrize("flat", [False, True])
def test_two_runs_with_air_give_the_same_bytes(flat: bool, tmp_path: Path, child: Child) -> None:
    code = 'write_stage(Capsule().describe(), Capsule().frames(9), os.environ["OUT"], flat=bool(os.environ["FLAT"]))'
    write_stage(Capsule().describe(), Capsule().frames(9), tmp_path / "here", flat=flat)
    process = child(code, OUT=str(tmp_path / "there"), FLAT="1" if flat else "", PYTHONHASHSEED="3")
    _, errors = process.communicate()
    assert process.returncode == 0, errors
    assert list(same_bytes(tmp_path / "here", tmp_path / "there")) == []


def test_one_point_that_moves_otherwise_changes_one_file(tmp_path: Path) -> None:
    write_stage(sculpture(), frames(4), tmp_path / "one")
    moved = list(frames(4))
    moved[2].points[0][10, 1] *= 0.9
    write_stage(sculpture(), iter(moved), tmp_path / "other")
    found = [str(finding) for finding in same_bytes(tmp_path / "one", tmp_path / "other")]
    assert len(found) == 1
    assert "draft_sim.usdc" in found[0]


BIG_AIR = """
few = Capsule(grid=(200, 10, 10))
(frame,) = few.frames(1)
def moving():
    for t in range(1, int(os.environ["COUNT"]) + 1):
        yield replace(frame, time_code=t, air=(frame.air[0] + np.float32(1e-4 * t),), cluster=((frame.cluster[0] + t) % 2,))
write_stage(few.describe(), moving(), os.environ["OUT"])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""


def test_memory_does_not_grow_with_frames_of_air(tmp_path: Path, child: Child) -> None:
    """20 000 particles whose clusters change in every frame: 200 frames are 112 MB."""
    peaks = []
    for count in (40, 240):
        output, errors = child(BIG_AIR, OUT=str(tmp_path / str(count)), COUNT=str(count)).communicate()
        assert output, errors
        peaks.append(int(output))
    assert (tmp_path / "240" / "capsule" / "payload" / "draft_sim.usdc").stat().st_size > 55e6
    assert peaks[1] - peaks[0] < 8, f"peak resident memory {peaks} MB for 40 and 240 frames"


def test_memory_does_not_grow_with_the_frames(tmp_path: Path, child: Child) -> None:
    """20 000 points at 12 bytes and more: 200 frames are 48 MB, of which few may stay in memory."""
    peaks = []
    for count in (40, 240):
        output, errors = child(BIG_RUN, OUT=str(tmp_path / str(count)), COUNT=str(count)).communicate()
        assert output, errors
        peaks.append(int(output))
    assert (tmp_path / "240" / "dog" / "payload" / "draft_sim.usdc").stat().st_size > 55e6
    assert peaks[1] - peaks[0] < 8, f"peak resident memory {peaks} MB for 40 and 240 frames"
