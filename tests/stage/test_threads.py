from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import balloon_usd

ROOT = Path(balloon_usd.__file__).parents[1]
WRITE_AT_ONCE = """
import sys, threading
import balloon_usd.stage
from pxr import Sdf

sys.setswitchinterval(1e-6)
together = threading.Barrier(8)

def write(number):
    together.wait()
    assert Sdf.Layer.CreateNew(f"{number}.usdc").Save()

for thread in [threading.Thread(target=write, args=(number,), daemon=True) for number in range(8)]:
    thread.start()
for thread in threading.enumerate():
    if thread is not threading.main_thread():
        thread.join()
"""


def test_the_first_layers_of_a_process_are_written_by_many_threads_at_once(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    for attempt in ("first", "second", "third"):
        folder = tmp_path / attempt
        folder.mkdir()
        subprocess.run(
            [sys.executable, "-c", WRITE_AT_ONCE], cwd=folder, env=environment, timeout=20, check=True
        )
        assert len(list(folder.iterdir())) == 8
