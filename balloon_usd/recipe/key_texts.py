"""What the texts below the keys of the recipe language say, read from the source when somebody asks."""

from __future__ import annotations

import ast
import inspect
import itertools
import textwrap
from functools import cache

from balloon_usd.operations.modifiers import Entries


def key_texts(model: type[Entries]) -> dict[str, str]:
    """Return what the texts below the keys of a model say of them, by key.

    Pydantic would read them at every start: 0.4 s of 1.3 s until all that a plan needs is imported.
    """
    found: dict[str, str] = {}
    for each in reversed(model.__mro__):
        if issubclass(each, Entries):
            found |= _own_texts(each)
    return {key: found[key] for key in model.model_fields if key in found}


@cache
def _own_texts(model: type[Entries]) -> dict[str, str]:
    found: dict[str, str] = {}
    (written,) = ast.parse(textwrap.dedent(inspect.getsource(model))).body
    for key, text in itertools.pairwise(getattr(written, "body", [])):
        match key, text:
            case ast.AnnAssign(target=ast.Name(name)), ast.Expr(ast.Constant(str(words))):
                found[name] = inspect.cleandoc(words)
    return found
