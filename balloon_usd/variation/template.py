"""The text of a recipe with marks where values go: comments and layout stay, and only values differ.

ruamel.yaml writes the text once, with marks for values, since that takes it as long as planning.
"""

from __future__ import annotations

import re
from copy import deepcopy
from dataclasses import dataclass
from io import StringIO
from typing import TYPE_CHECKING, Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import YAMLError
from ruamel.yaml.resolver import VersionedResolver
from ruamel.yaml.scalarstring import PlainScalarString

from balloon_usd.language.problem import RecipeError, escaped
from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.recipe.writer import flow_text
from balloon_usd.variation.error import VariationError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from balloon_usd.language.marks import Marks
    from balloon_usd.language.problem import Path

MARKS = range(0xE000, 0xF900)
"""Characters for private use: no recipe needs them, and values are written without."""
WIDTH = 2**31 - 1
"""Characters of a line: none is broken."""

_DASH = re.compile(r"( *)-( +)")


class _TextResolver(VersionedResolver):
    """Takes every plain value for text, which is written as it stood: 0x10 stays 0x10, and 1.50 does."""

    @property
    def versioned_resolver(self) -> dict[str, Any]:
        return {}


@dataclass(frozen=True)
class Template:
    """A recipe's text and the mark of each place that is filled."""

    text: str
    marks: Mapping[Path, str]

    def filled(self, values: Mapping[Path, object]) -> str:
        """Return the text with a value at each place."""
        text = self.text
        for path, mark in self.marks.items():
            text = text.replace(mark, flow_text(values[path]))
        return text


def template_of(text: str, file: str, paths: Sequence[Path]) -> Template:
    """Make a template of the text of a valid recipe; the last key of a path may be absent from it.

    Raises:
        VariationError: the text cannot be written with other values and its comments.
    """
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    document = read_yaml(text, file)
    data = document.data
    unused = (chr(code) for code in MARKS if chr(code) not in text)
    marks = {path: mark * _written_length(data, path) for path, mark in zip(paths, unused, strict=False)}
    if len(marks) < len(paths):
        what = f"too many characters for private use, expected {len(paths)} that it does not have"
        raise VariationError([f"{escaped(file)}: {what}"])
    expected = deepcopy(data)
    for path, mark in marks.items():
        _put(expected, path, mark)
    yaml = _yaml(text, document.marks)
    try:
        tree, written = yaml.load(text), StringIO()
        for path, mark in marks.items():
            _put(tree, path, PlainScalarString(mark))
        yaml.dump(tree, written)
        same = read_yaml(written.getvalue(), file).data == expected
    except (YAMLError, RecipeError):
        same = False
    if not same:
        what = "ruamel.yaml cannot keep the comments within its [] and {}, expected them on lines outside"
        raise VariationError([f"{escaped(file)}: {what}"])
    return Template(written.getvalue(), marks)


def _yaml(text: str, marks: Marks) -> YAML:
    """Return a reader and writer that indents as this text does: its balloons and its steps."""
    yaml = YAML()
    yaml.Resolver = _TextResolver
    yaml.preserve_quotes = True
    yaml.width = WIDTH
    yaml.brace_single_entry_mapping_in_flow_sequence = True
    head = marks.keys[("balloons",)]
    child = min(place for path, place in marks.keys.items() if path[:-1] == ("balloons",))
    mapping = child.column - head.column if child.line > head.line else 2
    step = marks.keys["steps", 0]
    dash = _DASH.fullmatch(text.splitlines()[step.line - 1][: step.column - 1])
    offset, gap = (len(dash[1]), len(dash[2])) if dash else (2, 1)
    yaml.indent(mapping=mapping, sequence=offset + 1 + gap, offset=offset)
    return yaml


def _written_length(data: Any, path: Path) -> int:
    """Return how long the value is that is replaced, so that comments behind it stay in line."""
    for key in path:
        if isinstance(data, dict) and key not in data:
            return 1
        data = data[key]
    return len(flow_text(data))


def _put(tree: Any, path: Path, value: str) -> None:
    """Set a value in plain data or in the tree that keeps comments."""
    *above, last = path
    for key in above:
        if isinstance(tree, dict) and key not in tree:
            tree[key] = CommentedMap()
            tree[key].fa.set_flow_style()
        tree = tree[key]
    if isinstance(tree, CommentedMap) and last not in tree:
        tree.insert(_free_place(tree), last, value)
        return
    if isinstance(tree, (CommentedMap, CommentedSeq)) and isinstance(tree[last], (dict, list)):
        _keep_comments(tree, last)
    tree[last] = value


def _free_place(tree: CommentedMap) -> int:
    """Return the last place of a mapping before which no comment stands."""
    keys = list(tree)
    return next((at for at in range(len(keys), 0, -1) if keys[at - 1] not in tree.ca.items), 0)


def _keep_comments(tree: CommentedMap | CommentedSeq, key: Any) -> None:
    """Of a collection that is replaced keep the comment behind its key, and what stands after its end."""
    slot = _slot(tree)
    behind, after = (tree.ca.items.pop(key, None) or [None] * 4)[slot], _comment_after(tree[key])
    if after is not None:
        following = after.value.partition("\n")[2]
        if behind is None:
            after.value = "\n"
            behind = after
        behind.value += following
    tree.ca.items[key] = [behind if at == slot else None for at in range(4)]


def _comment_after(value: Any) -> Any:
    """Return the token with the comment after the last entry of a collection, None where there is none."""
    while isinstance(value, (CommentedMap, CommentedSeq)) and value:
        last = list(value)[-1] if isinstance(value, CommentedMap) else len(value) - 1
        found = value.ca.items.get(last)
        if found and found[_slot(value)]:
            return found[_slot(value)]
        value = value[last]
    return None


def _slot(tree: CommentedMap | CommentedSeq) -> int:
    """Return where ruamel.yaml keeps the comment behind a value."""
    return 2 if isinstance(tree, CommentedMap) else 0
