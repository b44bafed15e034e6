"""The file of a job template: YAML or JSON, whole or not there."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import yaml

from balloon_usd.files.whole_file import write_whole

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
    """Write a template, whole or not at all.

    Raises:
        OSError: it cannot be written.
    """
    text = template_text(document, as_json=path.suffix.lower() == ".json")
    write_whole({path: text.encode("utf-8")})
