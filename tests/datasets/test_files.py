"""A file is whole or not there."""

import os
import stat
from pathlib import Path

import pytest

from roomgraph.datasets.camera import Intrinsics, read_camera, write_camera
from roomgraph.datasets.files import replace_folder, replacing, write_text


@pytest.fixture
def events(monkeypatch):
    """What reaches the disk, in order: each flush with the file's size, each new name."""
    seen, fsync, replace = [], os.fsync, Path.replace

    def flush(descriptor):
        status = os.fstat(descriptor)
        seen.append("folder" if stat.S_ISDIR(status.st_mode) else f"file of {status.st_size}")
        fsync(descriptor)

    def rename(self, target):
        seen.append(f"is {target.name}")
        return replace(self, target)

    monkeypatch.setattr(os, "fsync", flush)
    monkeypatch.setattr(Path, "replace", rename)
    return seen


def test_bytes_are_on_the_disk_before_the_name_is(tmp_path, events):
    write_text(tmp_path / "a.txt", "twelve bytes")
    assert events == ["file of 12", "is a.txt", "folder"]
    assert (tmp_path / "a.txt").read_text() == "twelve bytes"


def test_a_folder_is_flushed_as_a_whole(tmp_path, events, monkeypatch):
    monkeypatch.setattr(os, "sync", lambda: events.append("all"))
    (tmp_path / "new").mkdir()
    replace_folder(tmp_path / "new", tmp_path / "walk")
    assert events == ["all", "is walk", "folder"]


def test_a_folder_takes_the_place_of_an_old_one(tmp_path):
    for name in ("new", "model"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "a.txt").write_text(name)
    replace_folder(tmp_path / "new", tmp_path / "model")
    assert [p.name for p in tmp_path.iterdir()] == ["model"]
    assert (tmp_path / "model" / "a.txt").read_text() == "new"


def test_an_old_folder_stays_where_the_new_one_cannot_be_put(tmp_path):
    (tmp_path / "model").mkdir()
    (tmp_path / "model" / "a.txt").write_text("old")
    with pytest.raises(OSError, match="missing"):
        replace_folder(tmp_path / "missing", tmp_path / "model")
    assert [p.name for p in tmp_path.iterdir()] == ["model"]
    assert (tmp_path / "model" / "a.txt").read_text() == "old"


def test_a_system_that_flushes_no_folders_is_no_failure(tmp_path, monkeypatch):
    def refuse(name, flags):
        raise PermissionError(name)

    monkeypatch.setattr(os, "open", refuse)
    write_text(tmp_path / "a.txt", "new")
    assert (tmp_path / "a.txt").read_text() == "new"


def test_what_fails_leaves_the_old_file_alone(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")
    with pytest.raises(RuntimeError), replacing(path) as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("a.txt", "old")]


def test_a_camera_half_written_leaves_the_old_one(tmp_path, monkeypatch):
    path, write = tmp_path / "camera.json", Path.write_text
    write_camera(path, Intrinsics(64, 48, 50.0, 50.0, 31.5, 23.5), 1000)

    def full_disk(self, text, **options):
        write(self, text[:9], **options)
        raise OSError("no space left")

    monkeypatch.setattr(Path, "write_text", full_disk)
    with pytest.raises(OSError, match="no space"):
        write_camera(path, Intrinsics(32, 24, 25.0, 25.0, 15.5, 11.5), 5000)
    assert read_camera(path).intrinsics.width == 64
