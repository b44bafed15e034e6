"""Draw the pictures of operations from their examples, of a dog that is dropped, and of the gallery.

`python docs/pictures.py` draws all but the gallery on the CPU, `python docs/pictures.py press drop` some.
`python docs/pictures.py gallery` draws the last frames of all recipes, on a GPU if there is one: a CPU takes
a quarter of an hour. `python docs/pictures.py gallery tulip_bt` draws that of one. The README shows some of
these from one side.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from PIL import Image

from balloon_usd.cli import main
from balloon_usd.cli.failure import Failure
from balloon_usd.operations.moves import LetGo, Move
from balloon_usd.operations.table import BY_WORD, WORDS
from balloon_usd.plan import plan
from balloon_usd.preview.contact_sheet import GUTTER, HEADER, MARGIN
from balloon_usd.recipe import Recipe

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from balloon_usd.plan import Plan

PICTURES = Path(__file__).parent / "pictures" / "operations"
RECIPES = Path(__file__).parents[1] / "recipes"
DOG = RECIPES / "dog.yaml"
DROP = "drop"
"""The pose that has a picture, too."""
FALLEN = (0.0, 0.9, 1.25, 2.0, 5.0)
"""Times after the let-go at which the dog is drawn, s."""
SIZE, FINE = ("300", "220"), ("600", "440")
"""Width and height of one frame of an operation and of the gallery, pixels."""
GALLERY = "gallery"
VIEWS = ("three-quarter", "front-quarter")
"""From where every figure of the gallery is seen."""
TITLE = HEADER + MARGIN
"""Height of what is above the frames of a contact sheet, pixels."""
README = ("dog", "poodle", "dachshund", "giraffe", "elephant", "rabbit", "flower", "heart")
"""Figures that the README shows."""
QUALITY, EFFORT = 88, 6
"""Of pictures in WebP: as small as with a palette of 256 colours, which shows steps on shining walls."""


def draw(words: Sequence[str], folder: Path) -> None:
    """Simulate the examples of operations in a folder, and draw three frames of each."""
    plans = {}
    for word in words:
        file = folder / f"{word}.yaml"
        file.write_text(BY_WORD[word].example, encoding="utf-8")
        plans[word] = plan(Recipe.load(file))
    recipes = [str(folder / f"{word}.yaml") for word in words]
    _call("run", *recipes, "-o", str(folder), "--device", "cpu", "--no-report", "--no-preview")
    PICTURES.mkdir(exist_ok=True)
    for word in words:
        stage, frames = folder / plans[word].recipe.name, frames_of(plans[word], word)
        picture = _sheet(stage, frames, "three-quarter")
        if plans[word].graph.rings:
            # What closed rings make shows best from where the knot is.
            picture = _beside(picture, _sheet(stage, frames[-1:], "front-quarter"))
        _save(picture, PICTURES / word)


def draw_drop(folder: Path) -> None:
    """Simulate a dog that is dropped, and draw how it falls, lands and lies."""
    file = folder / f"{DROP}.yaml"
    file.write_text(DOG.read_text(encoding="utf-8") + f"pose: {DROP}\n", encoding="utf-8")
    made = plan(Recipe.load(file))
    _call("run", str(file), "-o", str(folder), "--device", "cpu", "--no-report", "--no-preview")
    let_go = made.choreography.moves[-1].start
    frames = [1 + round(made.recipe.fps * (let_go + time)) for time in FALLEN]
    picture = _sheet(folder / made.recipe.name, frames, "side")
    _save(picture, PICTURES.parent / DROP)


def draw_gallery(folder: Path, names: Collection[str]) -> None:
    """Simulate some recipes of latex, or all if none is named, and draw each figure as it is in the end, from
    two sides.
    """
    files = [file for file in gallery_recipes() if not names or file.stem in names]
    plans = [plan(Recipe.load(file)) for file in files]
    # One of them jams.
    with suppress(Failure):
        _call("run", *map(str, files), "-o", str(folder), "--no-report", "--no-preview")
    target = PICTURES.parent / GALLERY
    target.mkdir(exist_ok=True)
    for made in plans:
        name = made.recipe.name
        if (stage := folder / name).exists():
            frames = [_last_frame(stage, made.frame_count, view) for view in VIEWS]
            width, height = frames[0].size
            both = Image.new("RGB", (2 * width, height))
            for at, frame in enumerate(frames):
                both.paste(frame, (at * width, 0))
            _save(both, target / name)
            if name in README:
                _save(frames[0], PICTURES.parent / name)


def gallery_recipes() -> list[Path]:
    """Return all recipes of latex that come with the program."""
    folders = (RECIPES, RECIPES / "meshes", RECIPES / "book")
    return [file for folder in folders for file in sorted(folder.glob("*.yaml"))]


def _last_frame(stage: Path, frame: int, view: str) -> Image.Image:
    """Draw one frame of a stage without title and text, finely."""
    width, height = map(int, FINE)
    sheet = _sheet(stage, [frame], view, FINE, "auto")
    return sheet.crop((MARGIN, TITLE, MARGIN + width, TITLE + height))


def _sheet(
    stage: Path, frames: Sequence[int], view: str, size: Sequence[str] = SIZE, device: str = "cpu"
) -> Image.Image:
    """Draw frames of a stage in a row."""
    file = stage.with_name(f"{stage.name}_{view}.png")
    shown = ("--frames", ",".join(map(str, frames)), "--columns", str(len(frames)), "--size", *size)
    _call("preview", str(stage), "-o", str(file), *shown, "--view", view, "--device", device)
    with Image.open(file) as image:
        return image.convert("RGB")


def _save(picture: Image.Image, file: Path) -> None:
    """Save a picture; `file`: without its ending."""
    picture.save(file.with_suffix(".webp"), quality=QUALITY, method=EFFORT)


def _beside(sheet: Image.Image, more: Image.Image) -> Image.Image:
    """Put one frame at the end of a row, without its title."""
    begin = sheet.width - MARGIN + GUTTER
    frame = more.crop((MARGIN, TITLE, *more.size))
    both = Image.new("RGB", (begin + frame.width, sheet.height), sheet.getpixel((0, 0)))
    both.paste(sheet, (0, 0))
    both.paste(frame, (begin, TITLE))
    return both


def frames_of(plan: Plan, word: str) -> tuple[int, int, int]:
    """Return the frames before and during the last step with a word, and when all is made but still held."""
    moves = plan.choreography.moves
    finished = next(move.start for move in moves if isinstance(move, LetGo) and move.for_good)
    index = max(at for at, step in enumerate(plan.recipe.steps) if step.word == word)
    own = [move for move in moves if move.step == index and move.seconds > 0.0]
    begin = min((move.start for move in own), default=0.0)
    # Of several bubbles the middle one, while hands do what takes longest.
    work = [move for move in own if type(move) is not Move] or own
    longest = [move for move in work if move.seconds == max(each.seconds for each in work)]
    middle = longest[len(longest) // 2] if longest else None
    during = 0.5 * finished if middle is None else middle.start + 0.5 * middle.seconds
    first, second, third = (1 + round(plan.recipe.fps * time) for time in (begin, during, finished))
    return first, second, third


def _call(*words: str) -> None:
    main(list(words), standalone_mode=False)


if __name__ == "__main__":
    with TemporaryDirectory() as scratch:
        wanted = sys.argv[1:] or [*WORDS, DROP]
        figures = {file.stem for file in gallery_recipes()} & {*wanted} if GALLERY in wanted else set()
        if words := [word for word in wanted if word not in (DROP, GALLERY, *figures)]:
            draw(words, Path(scratch))
        if GALLERY in wanted:
            draw_gallery(Path(scratch), figures)
        if DROP in wanted:
            draw_drop(Path(scratch))
