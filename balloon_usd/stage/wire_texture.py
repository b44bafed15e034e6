"""The texture that leaves of a quad only its edges: a tiny grey PNG, the same for every sculpture."""

from __future__ import annotations

import struct
import zlib

import numpy as np

FILE_NAME = "wire.png"
SIDE = 64
"""Pixels along a side."""
LINE = 0.065
"""Width of the line along each edge, as a share of the quad; the quad beside it brings as much again."""
SLOPE = 6.0
"""Change of grey across the line's edge over one quad: gentle, so that the cut line is straight."""
CUT = 0.5
"""Grey above which there is wire."""


def wire_png() -> bytes:
    """Return the file: white at the edges, black in the middle, 8-bit grey, the same bytes everywhere."""
    middle = (np.arange(SIDE) + 0.5) / SIDE
    to_side = np.minimum(middle, 1.0 - middle)
    to_edge = np.minimum(to_side[:, None], to_side[None, :])
    grey = np.clip(CUT + SLOPE * (LINE - to_edge), 0.0, 1.0)
    rows = np.rint(255.0 * grey).astype(np.uint8)
    unfiltered = np.pad(rows, ((0, 0), (1, 0)))
    header = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 0, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", _stored(unfiltered.tobytes())), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, data) for kind, data in chunks)


def _stored(data: bytes) -> bytes:
    """Wrap up to 65 535 bytes in a zlib stream (RFC 1950, 1951) without compressing them.

    Compressors differ in their bytes from one build of zlib to the next.
    """
    block = struct.pack("<BHH", 1, len(data), 0xFFFF ^ len(data)) + data
    return b"\x78\x01" + block + struct.pack(">I", zlib.adler32(data))


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
