"""Long animations: time codes are compared as they are read, and none stays in memory."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np

from balloon_usd.stage import write_stage
from tests.stage.tubes import Frame, sculpture, tube_points

ROOT = Path(__file__).parents[2]
COMPARE = """
import resource, sys
from pathlib import Path
from balloon_usd.diff import compare_files
for found in compare_files(Path(sys.argv[1]), Path(sys.argv[2])).differences:
    print(found)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""


def write_long(folder: Path, count: int, moved: int) -> Path:
    """Two balloons of 5000 points each, 9 MB in 50 frames; one vertex stands aside at one time code."""
    rings = 625
    one, other = tube_points(rings, 0.0), tube_points(rings, 1.0)
    noise = np.random.default_rng(3).random(len(one), dtype=np.float32)
    gas = np.ones(5, np.float32)

    def moving():
        for t in range(1, count + 1):
            shift = np.float32(1e-4 * t)
            points = one + shift
            if t == moved:
                points[2500, 2] += np.float32(0.002)
            yield Frame(t, (points, other + shift), (noise + shift, noise - shift), gas * t, gas)

    return write_stage(sculpture(rings), moving(), folder).files[0]


def test_memory_does_not_grow_with_the_time_codes(tmp_path: Path) -> None:
    peaks = []
    for count in (50, 450):
        files = [write_long(tmp_path / f"{moved}_{count}", count, moved) for moved in (0, 40)]
        command = [sys.executable, "-c", COMPARE, *map(str, files)]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
        *told, peak = done.stdout.splitlines()
        assert told[0].startswith("/dog/geo/render/main: left_ear moved 2 mm at 40 (largest, vertex 2500)")
        peaks.append(int(peak))
    size = sum(file.stat().st_size for file in files[0].parent.rglob("*") if file.is_file())
    assert size > 60e6
    assert peaks[1] - peaks[0] < 8, f"peak resident memory {peaks} MB for 50 and 450 frames"
