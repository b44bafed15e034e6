"""Child processes that heed Ctrl-C, also where the tests themselves run in the background."""

from __future__ import annotations

import signal
import subprocess


def start(words, **options):
    """Start a process with its pipes open, interruptible as one that a user types."""
    pipe = subprocess.PIPE
    # What ignores the signal hands that on to its children, unless they are told otherwise.
    return subprocess.Popen(
        words, stdout=pipe, stderr=pipe, text=True, preexec_fn=_heed_interrupts, **options
    )


def _heed_interrupts():
    signal.signal(signal.SIGINT, signal.SIG_DFL)
