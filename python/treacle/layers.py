# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The direction of the C++ sources: a file includes only what stands in its own room or in
a group before it in GROUPS; rooms of one group do not know each other, and modules (x.h with
x.cc) form no cycle."""

import re

GROUPS = [["base"], ["geometry", "solvers"], ["mesh", "scene"], ["fields"],
          ["surface", "pressure", "viscosity"], ["transport", "dynamics"], ["io"],
          ["time_stepping", "warnings"], ["simulator"], ["main"]]
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]((?:treacle/|\.)[^>"]*)[>"]')


def room(module):
    """The room of a module like mesh/octree or main."""
    return module.split("/")[0]


def group(name):
    """The index of the group that a room belongs to, or None."""
    return next((i for i, rooms in enumerate(GROUPS) if name in rooms), None)


def includes(root):
    """Yield (place, line, including module, included module)."""
    for folder in (root / "include" / "treacle", root / "source"):
        for path in sorted(folder.rglob("*")):
            if path.suffix not in (".h", ".cc") or path.name == "pch.h":
                continue
            module = path.relative_to(folder).with_suffix("").as_posix()
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match:
                    target = match[1].removeprefix("treacle/").removesuffix(".h")
                    place = f"{path.relative_to(root)}:{number}"
                    yield place, line.strip(), module, target


def find_cycle(graph):
    """A list of modules that include each other in a ring, or None."""
    done, path = set(), []

    def visit(module):
        if module in path:
            return path[path.index(module):] + [module]
        if module in done:
            return None
        path.append(module)
        for target in sorted(graph.get(module, ())):
            cycle = visit(target)
            if cycle:
                return cycle
        path.pop()
        done.add(module)
        return None

    return next(filter(None, map(visit, sorted(graph))), None)


def problems(root):
    """A line for each include, and for one cycle, that breaks the order below a directory."""
    graph = {}
    for place, line, module, target in includes(root):
        here, there = room(module), room(target)
        if group(here) is None:
            yield f"{place}: \"{module}\" is in no room of GROUPS"
        elif group(there) is None:
            yield f"{place}: {line}  (in no room of GROUPS)"
        elif here != there and group(there) >= group(here):
            yield f"{place}: {line}  ({here} must not know {there})"
        if target != module:
            graph.setdefault(module, set()).add(target)
    if cycle := find_cycle(graph):
        yield "cycle: " + " -> ".join(cycle)
