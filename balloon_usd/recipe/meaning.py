"""Does a recipe make sense as a whole: names, order, balloons. No physics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of, unknown
from balloon_usd.language.names import NAME_LIMIT, rest_name
from balloon_usd.language.problem import PROBLEMS_SHOWN, Complaint, Path, path_text, quoted

from .balloons import FILLINGS, FLAT_ONLY
from .mesh_words import mesh_complaints, meshes_in
from .model_words import model_complaints
from .outline import StepOutline, balloons_in, outlines_in
from .steps import KINDS, MAKING, MANNERS, PRESSING, Joint

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

Vertex = tuple[str, int]
"""Joint number (0 = knot) on a balloon."""


def meaning_complaints(data: object) -> list[Complaint]:
    """List what does not make sense in the plain data of a recipe, of whatever shape it is."""
    workbench, meshes = _Workbench(data), meshes_in(data)
    for balloon, entry in balloons_in(data).items():
        if balloon not in meshes:
            workbench.check_filling(balloon, entry)
    for step in () if meshes else workbench.steps:
        if workbench.full:
            break
        workbench.check(step)
    return [*workbench.complaints, *mesh_complaints(data), *model_complaints(data)]


class _Workbench:
    """What has been made so far: bubbles on balloons, and which joints are already one."""

    def __init__(self, data: object) -> None:
        self.steps = outlines_in(data)
        self.complaints: list[Complaint] = []
        self._balloons: dict[str, list[str]] = {name: [] for name in balloons_in(data)}
        self._bubbles: dict[str, Vertex | None] = {}
        self._made_at: dict[str, Path] = {}
        self._ended: dict[str, Path] = {}
        self._joined: dict[Vertex, Vertex] = {}
        self._made_ever: dict[str, Path] = {}
        for step in self.steps:
            for name, path, _ in step.made:
                self._made_ever.setdefault(name, path)
        self._rests = self._automatic_rests()

    @property
    def full(self) -> bool:
        """More complaints than anybody reads."""
        return len(self.complaints) > PROBLEMS_SHOWN

    def check(self, step: StepOutline) -> None:
        self._check_operation(step)
        self._check_manners(step)
        balloon = self._balloon_of(step)
        for name, path, merged in step.made:
            self._make(name, path, balloon, merged)
        if step.rest is not None and balloon is not None:
            self._ended.setdefault(balloon, (*step.path, "rest"))
        if step.lock is not None:
            self._check_lock_list(step, step.lock)
        if step.joints is not None:
            self._check_lock_joints(step, step.joints)
        for name in step.bent:
            self._find_whole(name, step, (*step.path, "bend", name))
        if step.pushed is not None:
            self._find_whole(step.pushed, step, (*step.path, "push", "bubble"))
        self._check_pressing(step)
        self._check_owner(step)

    def check_filling(self, balloon: str, entry: object) -> None:
        if not isinstance(entry, dict):
            return
        path: Path = ("balloons", balloon)
        if "size" not in entry:
            self._complain((*path, "size"), "is missing, expected the size of the balloon, such as 260")
        given = [key for key in FILLINGS if key in entry]
        if not given:
            self._complain(path, f"does not say how far it is blown up, expected {one_of(FILLINGS)}")
        for extra in given[1:]:
            what = f"stands beside {given[0]}, expected exactly {one_of(FILLINGS)}"
            self._complain((*path, extra), what)
        if given == ["capsule"]:
            for key in entry:
                if key in FLAT_ONLY:
                    what = "makes no sense with capsule, which is no flat tube, expected no such entry"
                    self._complain((*path, key), what)

    def _complain(self, path: Path, text: str) -> None:
        self.complaints.append(Complaint(path, text))

    def _check_operation(self, step: StepOutline) -> None:
        if not step.kinds:
            self._complain(step.path, f"no operation, expected {one_of(KINDS)}")
        for extra in step.kinds[1:]:
            what = f"stands beside {step.kinds[0]}, expected one operation in a step: begin a new step"
            self._complain((*step.path, extra), what)

    def _check_manners(self, step: StepOutline) -> None:
        if len(step.kinds) != 1:
            return
        kind = step.kinds[0]
        for key in step.keys:
            if key != kind and key not in MANNERS[kind]:
                what = f"makes no sense with {kind}, expected {one_of(MANNERS[kind])}"
                self._complain((*step.path, key), what)

    def _balloon_of(self, step: StepOutline) -> str | None:
        """Find the balloon a step works on; None when that cannot be known."""
        known = list(self._balloons)
        if step.balloon is not None:
            if step.balloon in self._balloons:
                return step.balloon
            if known:
                self._complain((*step.path, "balloon"), unknown("balloon", step.balloon, known))
            return None
        if len(known) > 1 and any(kind in MAKING for kind in step.kinds) and "balloon" not in step.keys:
            what = f"does not say on which balloon, expected balloon: {one_of(known)}"
            self._complain(step.path, what)
        return known[0] if len(known) == 1 else None

    def _make(self, name: str, path: Path, balloon: str | None, merged: bool) -> None:
        if name in self._made_at:
            first = path_text(self._made_at[name])
            self._complain(path, f"bubble {quoted(name)} was made at {first}, expected a new name")
            return
        self._made_at[name] = path
        self._bubbles[name] = None
        if balloon is None:
            return
        if balloon in self._ended:
            end = path_text(self._ended[balloon])
            what = f"balloon {quoted(balloon)} has ended at {end}, expected nothing made of it after its rest"
            self._complain(path, what)
        at = len(self._balloons[balloon])
        self._balloons[balloon].append(name)
        self._bubbles[name] = (balloon, at)
        if merged:
            self._merge([(balloon, at), (balloon, at + 1)])

    def _find(self, name: str, path: Path, rests: Iterable[str] = ()) -> bool:
        """Say whether a bubble exists by now, and complain if it does not; `rests` could be meant, too."""
        if name in self._made_at:
            return True
        later = self._made_ever.get(name)
        if later is not None:
            what = f"bubble {quoted(name)} does not exist yet, it is made at {path_text(later)}"
            self._complain(path, f"{what}: expected this step after that one")
        elif len(name) <= NAME_LIMIT and not self.full:
            self._complain(path, unknown("bubble", name, [*self._made_at, *rests]))
        elif not self.full:
            self._complain(path, f"unknown bubble {quoted(name)}")
        return False

    def _automatic_rests(self) -> dict[str, tuple[str, int]]:
        """Balloons whose rest no step names: by the rest's name, its balloon and the last step that makes
        something of it.
        """
        only = next(iter(self._balloons)) if len(self._balloons) == 1 else None
        last = dict.fromkeys(self._balloons, -1)
        ended = set()
        for step in self.steps:
            balloon = step.balloon or only
            if balloon in last and step.made:
                last[balloon] = int(step.path[1])
            if step.rest is not None:
                ended.add(balloon)
        names = {rest_name(balloon, self._made_ever): balloon for balloon in last if balloon not in ended}
        return {name: (balloon, last[balloon]) for name, balloon in names.items()}

    def _find_whole(self, name: str, step: StepOutline, path: Path) -> None:
        """Complain if a bubble, which may be an unnamed rest, does not exist by now."""
        here = int(step.path[1])
        if name not in self._rests:
            self._find(name, path, (rest for rest, (_, last) in self._rests.items() if last <= here))
            return
        balloon, last = self._rests[name]
        if last > here:
            what = f"bubble {quoted(name)} does not exist yet, steps[{last}] makes more of {quoted(balloon)}"
            self._complain(path, f"{what}: expected this step after that one")

    def _check_pressing(self, step: StepOutline) -> None:
        path = (*step.path, "push")
        if step.pressing is not None and len(step.pressing) == 0:
            self._complain(path, f"does not say how deep or how hard, expected {one_of(PRESSING)}")
        elif step.pressing is not None and len(step.pressing) > 1:
            what = f"stands beside {step.pressing[0]}, expected exactly {one_of(PRESSING)}"
            self._complain((*path, step.pressing[1]), what)

    def _check_lock_list(self, step: StepOutline, names: Sequence[str]) -> None:
        path = (*step.path, "lock")
        found = [self._find(name, path) for name in names]
        if not step.well_formed or not all(found):
            return
        if len(set(names)) < len(names):
            self._complain(path, "names a bubble twice, expected each once")
        elif len(names) < 2:
            what = "expected at least two bubbles; one bubble closes on itself with loop, fold or ear"
            self._complain(path, f"{len(names)} bubbles cannot be locked, {what}")
        else:
            self._check_neighbours(path, names)

    def _check_neighbours(self, path: Path, names: Sequence[str]) -> None:
        places = [place for name in names if (place := self._bubbles[name])]
        if len(places) < len(names):
            return
        joints = f"lock: {{joints: [{names[0]}.start, {names[-1]}.end]}}"
        balloons = list(dict.fromkeys(balloon for balloon, _ in places))
        if len(balloons) > 1:
            what = f"bubbles of different balloons ({', '.join(balloons)}), expected {joints}"
            self._complain(path, what)
            return
        order = self._balloons[balloons[0]]
        first, last = min(at for _, at in places), max(at for _, at in places)
        run = order[first : last + 1]
        if run == list(names):
            self._lock(path, [(balloons[0], first), (balloons[0], last + 1)], names)
        elif len(run) == len(names):
            self._complain(path, f"not in the order of the balloon, expected [{', '.join(run)}]")
        else:
            between = ", ".join(name for name in run if name not in names)
            self._complain(path, f"no neighbours ({between} between them), expected all of them or {joints}")

    def _check_lock_joints(self, step: StepOutline, joints: Sequence[Joint]) -> None:
        path = (*step.path, "lock", "joints")
        found = [self._find(joint.bubble, path) for joint in joints]
        if not step.well_formed or not all(found):
            return
        if len(joints) < 2:
            self._complain(path, f"{len(joints)} joints cannot be locked, expected at least two")
            return
        vertices = [vertex for joint in joints if (vertex := self._vertex(joint))]
        if len(vertices) == len(joints):
            self._lock(path, vertices, [str(joint) for joint in joints])

    def _vertex(self, joint: Joint) -> Vertex | None:
        place = self._bubbles[joint.bubble]
        return place and (place[0], place[1] + (joint.end == "end"))

    def _lock(self, path: Path, vertices: Sequence[Vertex], names: Sequence[str]) -> None:
        """Merge joints; a lock in which two are already one was meant otherwise."""
        if len({self._root(vertex) for vertex in vertices}) < len(vertices):
            what = f"{', '.join(names)}: these joints are already one, expected different joints"
            self._complain(path, what)
        self._merge(vertices)

    def _root(self, vertex: Vertex) -> Vertex:
        while vertex in self._joined:
            vertex = self._joined[vertex]
        return vertex

    def _merge(self, vertices: Sequence[Vertex]) -> None:
        first = self._root(vertices[0])
        for vertex in vertices[1:]:
            root = self._root(vertex)
            if root != first:
                self._joined[root] = first

    def _check_owner(self, step: StepOutline) -> None:
        """A lock, bend or push that names its balloon must stay on it."""
        if step.balloon not in self._balloons:
            return
        named: Iterable[str] = (
            *(step.lock or ()),
            *(joint.bubble for joint in step.joints or ()),
            *step.bent,
            *filter(None, [step.pushed]),
        )
        for name in named:
            place = self._bubbles.get(name) or self._rests.get(name)
            if place and place[0] != step.balloon:
                what = (
                    f"bubble {quoted(name)} is on balloon {quoted(place[0])}, expected no other balloon named"
                )
                self._complain((*step.path, "balloon"), what)
