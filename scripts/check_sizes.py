#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors

"""List functions, sources and headers that are two ideas: longer than 40, 300 and 150
lines. A function counts from its return type to its closing brace.

usage: check_sizes.py [ROOT]    exit code 1 if any is longer than the tolerance in LIMITS
"""

import argparse
import pathlib
import re
import sys

LIMITS = {"function": (40, 45), "source": (300, 320), "header": (150, 200)}
UNSEEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ ]*#[^\n]*',
                    re.DOTALL | re.MULTILINE)
TEMPLATE = re.compile(r"\s*template\s*<[^<>]*(?:<[^<>]*>[^<>]*)*>")
LABEL = re.compile(r"\s*(?:public|protected|private)\s*:(?!:)")
SCOPE = re.compile(r"\s*(?:inline\s+)?(?:namespace|extern)\b|\s*(?:class|struct|union|enum)\b[^()]*$")
BODY_FOLLOWS = re.compile(r"(?:\)|\}|\b(?:const|override|final|noexcept|try))\s*$")


def blank(match):
    """As many lines without anything that could be taken for code."""
    text = match[0]
    return "\n" * text.count("\n") if text[0] in "/ #" else "0"


def name_of(header):
    """The name of the function that a header declares."""
    return re.search(r"([\w:~<>]*(?:operator\s*[^\s\w(]+)?)\s*\(", header)[1] or "function"


def matching_brace(text, place):
    """The place of the brace that closes the one at place."""
    depth = 0
    for match in re.compile(r"[{}]").finditer(text, place):
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return match.start()
    return len(text) - 1


def functions(text):
    """Yield (first line, number of lines, name) of the functions in a file."""
    text = UNSEEN.sub(blank, text)
    begin = place = 0
    while match := re.compile(r"[;{}]").search(text, place):
        place = match.end()
        if match[0] != "{":
            begin = place
            continue
        while prefix := LABEL.match(text, begin) or TEMPLATE.match(text, begin):
            begin = prefix.end()
        header = text[begin:match.start()]
        if SCOPE.match(header):
            begin = place
            continue
        end = matching_brace(text, match.start())
        place = end + 1
        if "(" in header and BODY_FOLLOWS.search(header):
            first = text.count("\n", 0, begin + len(header) - len(header.lstrip())) + 1
            yield first, text.count("\n", 0, end) + 2 - first, name_of(header)
            begin = place


def lengths(root):
    """Yield (kind, lines, place) of all there is."""
    for folder in (root / "include", root / "source"):
        for path in sorted(folder.rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            text, place = path.read_text(), path.relative_to(root)
            yield "header" if path.suffix == ".h" else "source", text.count("\n"), place
            for first, n, name in functions(text):
                yield "function", n, f"{place}:{first}: {name}()"


def main():
    parser = argparse.ArgumentParser(description="Lists functions, sources and headers that are too long.")
    parser.add_argument("root", metavar="ROOT", nargs="?", type=pathlib.Path,
                        default=pathlib.Path(__file__).parent.parent)
    root = parser.parse_args().root
    too_long = False
    for kind, n, place in lengths(root):
        limit, tolerance = LIMITS[kind]
        if n > limit:
            print(f"{place}: {n} lines, a {kind} has {limit}" + (" at most" if n > tolerance else ""))
            too_long |= n > tolerance
    print("sizes: too long" if too_long else "sizes: in order")
    return 1 if too_long else 0


if __name__ == "__main__":
    sys.exit(main())
