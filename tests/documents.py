#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors

"""Check that the documents speak of files that exist: relative links, paths that begin with
a directory of the repository, and quoted paths that begin with a room, as `mesh/octree`.
Of the changelog only links, for what it says of older files was true.

usage: documents.py [ROOT]    prints file:line of what is wrong, exit code 1 if anything
"""

import pathlib
import re
import sys
import urllib.parse

DIRECTORIES = "source|include|tests|prm|scripts|python|doc|benchmarks"
LINK = re.compile(r"\[[^\]]*\]\(\s*<?([^)\s>]+)>?[^)]*\)")
PATH = re.compile(rf"(?<![\w/.<-])(?:{DIRECTORIES})/[\w./*+=-]*")
QUOTED = re.compile(r"`([^`]+)`")
PLACEHOLDERS = {"CASE", "FILE", "SCENE", "name", "x"}


def documents(root):
    """The texts to be checked, the changelog last."""
    yield from (root / name for name in ("README.md", "CONTRIBUTING.md"))
    yield from sorted((root / "doc").rglob("*.md"))
    yield root / "CHANGELOG.md"


def exists(folder, path):
    """Is there such a file or directory, or for a path with stars one that fits?"""
    if "*" in path:
        return any(folder.glob(path))
    return (folder / path).exists()


def in_room(root, path):
    """Is there such a header or source, with its ending or without?"""
    return any(exists(folder, path + ending)
               for folder in (root / "include" / "treacle", root / "source")
               for ending in ("", ".h", ".cc"))


def is_placeholder(path):
    return any(part.split(".")[0] in PLACEHOLDERS for part in path.split("/"))


def wrong_links(document, line):
    """Links to files that are not there."""
    for link in LINK.findall(line):
        target = urllib.parse.unquote(link.split("#")[0])
        if target and not re.match(r"\w+:", target) and not exists(document.parent, target):
            yield link


def wrong_paths(root, rooms, line):
    """Paths of the repository that are not there."""
    # what a link leads to is relative to the document
    text = re.sub(r"\]\([^)]*\)", "]", line)
    for match in PATH.findall(text):
        path = match.rstrip(".-+=")
        if not is_placeholder(path) and not exists(root, path):
            yield path
    for quoted in QUOTED.findall(text):
        path = quoted.split()[0] if quoted.split() else ""
        if (path.split("/")[0] in rooms and re.fullmatch(r"[a-z_]+/[a-z_*.]+", path)
                and not in_room(root, path)):
            yield path


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    rooms = {path.name for path in (root / "include" / "treacle").iterdir() if path.is_dir()}
    problems = []
    for document in documents(root):
        place = document.relative_to(root)
        for number, line in enumerate(document.read_text().splitlines(), 1):
            wrong = list(wrong_links(document, line))
            if document.name != "CHANGELOG.md":
                wrong += wrong_paths(root, rooms, line)
            problems += [f"{place}:{number}: {path} does not exist" for path in dict.fromkeys(wrong)]
    print("\n".join(problems) if problems else "documents: all paths exist")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
