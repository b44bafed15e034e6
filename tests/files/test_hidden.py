from __future__ import annotations

from balloon_usd.cli.child_process import remove_unfinished
from balloon_usd.files.hidden import matching
from balloon_usd.stage.workspace import sweep

FOLDERS = [".dog.abcd1234.writing", ".dog_0001.abcd1234.writing", ".doggy.abcd1234.writing", "dog"]


def left_of(folders, folder):
    for name in folders:
        (folder / name).mkdir()
    return lambda: sorted(path.name for path in folder.iterdir())


def test_names_have_the_form_of_any_pattern(tmp_path):
    left_of(FOLDERS, tmp_path)
    found = matching(tmp_path, ".dog.????????.writing", ".dog_*.writing")
    assert [path.name for path in found] == FOLDERS[:2]
    assert [path.name for path in matching(tmp_path, "*")] == sorted(FOLDERS)
    assert matching(tmp_path, ".[ab]*") == []


def test_leftovers_of_several_names_are_swept(tmp_path):
    left = left_of(FOLDERS, tmp_path)
    sweep("dog_*", tmp_path)
    assert left() == [".dog.abcd1234.writing", ".doggy.abcd1234.writing", "dog"]


def test_hidden_folders_of_a_crashed_export_are_removed(tmp_path):
    left = left_of(FOLDERS, tmp_path)
    remove_unfinished(tmp_path, "dog_")
    assert left() == [".dog.abcd1234.writing", ".doggy.abcd1234.writing", "dog"]
