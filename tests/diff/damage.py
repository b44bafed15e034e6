"""Ways in which a stage can be unfit for comparison: each damages the layered dog and says what is told."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

HEAD = "#usda 1.0\n"


def _without(name: str) -> Callable[[Path], Path]:
    def remove(folder: Path) -> Path:
        (folder / name).unlink()
        return folder

    return remove


def _with(name: str, change: Callable[[bytes], bytes]) -> Callable[[Path], Path]:
    def rewrite(folder: Path) -> Path:
        file = folder / name
        file.write_bytes(change(file.read_bytes()))
        return folder

    return rewrite


def _alone(name: str, content: bytes) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        file = folder / name
        file.write_bytes(content)
        return file

    return write


def _half(content: bytes) -> bytes:
    return content[: len(content) // 2]


def _pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe.usda")
    return folder / "pipe.usda"


def _text(body: str) -> bytes:
    return (HEAD + body).encode()


DAMAGES: dict[str, tuple[Callable[[Path], Path], str]] = {
    "missing": (lambda folder: folder / "nothing.usda", r"nothing\.usda is not a file$"),
    "folder of another name": (lambda folder: folder / "payload", r"payload/payload\.usda is not a file$"),
    "too long a name": (lambda folder: folder / ("x" * 300), "cannot be read: File name too long$"),
    "null in the name": (lambda folder: folder / "a\0b.usda", "holds control characters, which USD refuses$"),
    "pipe": (_pipe, r"pipe\.usda is not a file$"),
    "empty": (_alone("empty.usda", b""), "is not a USD file, or not a whole one: "),
    "garbage as text": (_alone("noise.usda", bytes(range(256)) * 40), "is not a USD file"),
    "garbage as binary": (_alone("noise.usdc", bytes(range(256)) * 40), "is not a USD file"),
    "garbage after the magic": (_alone("noise.usdc", b"PXR-USDC" + bytes(200)), "is not a USD file"),
    "another format": (_alone("mesh.obj", b"v 0 0 0\n"), "is not a USD file"),
    "half an interface": (_with("dog.usda", _half), "is not a USD file, or not a whole one"),
    "no payload": (_without("payload/draft.usda"), r"is not whole: Could not open asset .*draft\.usda"),
    "no samples": (_without("payload/draft_sim.usdc"), r"is not whole: .*draft_sim\.usdc"),
    "half the samples": (
        _with("payload/draft_sim.usdc", _half),
        r"is not whole: .*draft_sim\.usdc.*truncated",
    ),
    "no prims": (_alone("bare.usda", _text("")), r"bare\.usda has no prims$"),
    "no range": (
        _alone("r.usda", _text("(\n startTimeCode = 5\n endTimeCode = 4\n)\ndef Xform 'a' {}\n")),
        "has no frames: it begins at 5 and ends at 4$",
    ),
    "no samples of points": (
        _alone("z.usda", _text("def Mesh 'm'\n{\n point3f[] points.timeSamples = {\n }\n}\n")),
        "has no frames: /m has points without any sample$",
    ),
    "a circle of references": (
        _alone("c.usda", _text("def 'a' (references = </b>) {}\ndef 'b' (references = </a>) {}\n")),
        "is not whole: ",
    ),
}
"""What is done to the folder of the dog, and what the one line says."""
