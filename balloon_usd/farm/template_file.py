"""The file of a job template: YAML or JSON, whole or not there."""

from __future__ import annotations

import json
import secrets
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import yaml

if TYPE_CHECKING:
    from pathlib import Path

ENDINGS = (".yaml", ".yml", ".json")
"""Of files that OpenJD reads."""
WIDTH = 110


class _Dumper(yaml.SafeDumper):
    """Writes text of several lines as it is, a line a line."""


def _text_node(dumper: _Dumper, text: str) -> yaml.ScalarNode:
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style="|" if "\n" in text else None)


_Dumper.add_representer(str, _text_node)


def template_text(document: dict[str, Any], *, as_json: bool = False) -> str:
    """Return a template as YAML, or as JSON."""
    if as_json:
        return json.dumps(document, indent=2, ensure_ascii=False) + "\n"
    return yaml.dump(document, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=WIDTH)


def write_template(document: dict[str, Any], path: Path) -> None:
    """Write a template, beside its final name first: no half-written one is ever seen.

    Raises:
        OSError: it cannot be written.
    """
    text = template_text(document, as_json=path.suffix.lower() == ".json")
    partial = path.with_name(f".{path.name}.{secrets.token_hex(4)}.partial")
    try:
        with partial.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
        partial.replace(path)
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)
