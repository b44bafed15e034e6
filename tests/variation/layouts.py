"""One recipe in many layouts, as hypothesis draws them: blocks and braces, quotes, indents, comments."""

from __future__ import annotations

from hypothesis import strategies as st

RECIPE = {
    "format": 1,
    "name": "dog",
    "title": "It's a dog",
    "units": "cm",
    "balloons": {
        "main": {"size": 260, "color": [1, 0, 0.5], "tail": 10},
        "other": {"size": "160", "tail": 0},
    },
    "steps": [
        {"bubbles": {"nose": 10, "left_ear": 10, "right_ear": 10}, "balloon": "main"},
        {"lock": ["left_ear", "right_ear"], "point": "up"},
        {"rest": "tail", "balloon": "main"},
        {"wait": 1},
    ],
    "physics": {"friction": 0.5, "kosaka": {"swell": 0.03}},
}
"""Plain data of a recipe with every form of entry."""

COMMENTS = ["# a", "#b: {c", "# - d: [", '# "']


class Layout:
    """Writes plain data as YAML in a layout that is drawn on the way."""

    def __init__(self, draw):
        self._choose = lambda *choices: draw(st.sampled_from(choices))
        self._commented = draw(st.booleans())
        self._dash, self._child = self._choose(0, 2, 4), self._choose(2, 3, 4)
        self.comments = []

    def text(self, data):
        lines = []
        self._block(data, 0, lines)
        return "\n".join(lines) + "\n"

    def _block(self, data, indent, lines):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            self._comment(indent, lines)
            begin = " " * indent + (f"{key}:" if isinstance(data, dict) else "-")
            if not isinstance(value, (dict, list)) or key == "at" or self._choose(True, False):
                # Behind an item in braces, ruamel.yaml lets a comment take the place of the one above it.
                braces = isinstance(data, list) and isinstance(value, (dict, list))
                lines.append(f"{begin} {self._flow(value)}{'' if braces else self._behind()}")
            elif isinstance(data, list):
                inner = []
                self._block(value, indent + 2, inner)
                at = next(at for at, line in enumerate(inner) if line.strip()[:1] not in ("", "#"))
                inner[at] = f"{begin} {inner[at].lstrip()}"
                lines += inner
            else:
                lines.append(f"{begin}{self._behind()}")
                self._block(value, indent + (self._dash if isinstance(value, list) else self._child), lines)

    def _comment(self, indent, lines):
        if self._commented and self._choose(True, False, False):
            self.comments.append(f"{self._choose(*COMMENTS)} {len(self.comments)}.")
            lines += [self._choose("", " " * indent) + self.comments[-1], *self._choose([], [""])]

    def _behind(self):
        if not self._commented or self._choose(True, False):
            return ""
        self.comments.append(f"{self._choose(*COMMENTS)} {len(self.comments)}.")
        return self._choose(" ", "    ") + self.comments[-1]

    def _flow(self, value):
        space = self._choose("", " ", "\n" + " " * 9) if isinstance(value, (dict, list)) else ""
        if isinstance(value, dict):
            return (
                "{" + space + ", ".join(f"{key}: {self._flow(entry)}" for key, entry in value.items()) + "}"
            )
        if isinstance(value, list):
            return "[" + space + ", ".join(map(self._flow, value)) + "]"
        if not isinstance(value, str):
            return str(value)
        quoted = f'"{value}"', "'" + value.replace("'", "''") + "'"
        return self._choose(*quoted) if value == "160" else self._choose(value, *quoted)
