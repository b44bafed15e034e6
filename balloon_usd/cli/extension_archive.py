"""The extension for Blender, packed into the file that Blender installs."""

from __future__ import annotations

import io
import tomllib
import zipfile
from pathlib import Path

import balloon_usd
from balloon_usd.files.whole_file import write_whole

SOURCE = Path(balloon_usd.__file__).with_name("blender")
"""Where the extension lies; it is read, never imported."""
MANIFEST = "blender_manifest.toml"
DATE = (1980, 1, 1, 0, 0, 0)
"""Date of every file in the archive, so that equal files give equal bytes."""
READABLE = 0o644 << 16
UNIX = 3


def archive_name() -> str:
    """Return the name that Blender's own tool would give the archive."""
    manifest = tomllib.loads((SOURCE / MANIFEST).read_text(encoding="utf-8"))
    return f"{manifest['id']}-{manifest['version']}.zip"


def write_archive(file: Path) -> None:
    """Write the archive; it is whole or not there.

    Raises:
        OSError: the file cannot be written.
    """
    write_whole({file: _packed()})


def _packed() -> bytes:
    """Pack the extension, stored: how zlib packs differs from one machine to another."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_STORED) as archive:
        for path in sorted(path for path in SOURCE.iterdir() if path.is_file()):
            entry = zipfile.ZipInfo(path.name, DATE)
            entry.external_attr, entry.create_system = READABLE, UNIX
            archive.writestr(entry, path.read_bytes())
    return packed.getvalue()
