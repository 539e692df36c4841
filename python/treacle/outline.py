# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What bounds the liquid in a rectangle or a box, from its free surface.

The free surface ends at the walls; the outline of the liquid goes on along
them. The liquid is on the left of an edge, so it is on the left of the outline.
"""

import numpy
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree


def merge(points, facets, tolerance):
    """Points closer than the tolerance become one; facets that vanish are dropped.
    Returns the facets and, for each point, the one that stands for it."""
    pairs = cKDTree(points).query_pairs(tolerance, output_type="ndarray")
    n = len(points)
    graph = coo_matrix((numpy.ones(len(pairs)), pairs.T), shape=(n, n))
    label = connected_components(graph, directed=False)[1]
    _, first = numpy.unique(label, return_index=True)
    representative = first[label]
    facets = representative[facets]
    distinct = [facets[:, i] != facets[:, i - 1] for i in range(facets.shape[1])]
    return facets[numpy.all(distinct, axis=0)], representative


def chains(edges):
    """Oriented edges as lists of vertices; a closed one repeats its first vertex."""
    following = {}
    for a, b in edges.tolist():
        following.setdefault(a, []).append(b)
    ends = {b for _, b in edges.tolist()}
    open_starts = [a for a in following if a not in ends]
    result = []
    for start in open_starts + list(following):
        while following.get(start):
            chain = [start]
            while following.get(chain[-1]):
                chain.append(following[chain[-1]].pop())
                if chain[-1] == start:
                    break
            result.append(chain)
    return result


def liquid_loops(points, edges, lower, upper):
    """Closed polygons (k x 2) with the liquid on their left, whose edges are the
    given ones and pieces of the rectangle's boundary."""
    if len(edges) == 0:
        return []
    size = upper - lower
    edges, _ = merge(points, edges, 1e-7 * size.max())
    corners = lower + size * numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    loops, pieces = [], []
    for chain in chains(edges):
        closed = chain[0] == chain[-1]
        (loops if closed else pieces).append(points[chain])

    starts = [_perimeter(piece[0], lower, size) for piece in pieces]
    used = [False] * len(pieces)
    for first in range(len(pieces)):
        loop, k = [], first
        while not used[k]:
            used[k] = True
            loop.append(pieces[k])
            at = _perimeter(pieces[k][-1], lower, size)
            ahead = [(s - at + 1e-6) % 4 for s in starts]
            k = int(numpy.argmin(ahead))
            passed = [c for c in range(int(at) + 1, int(at) + 5) if c < at + ahead[k]]
            loop.append(corners[[c % 4 for c in passed]].reshape(-1, 2))
        if loop:
            loops.append(numpy.concatenate(loop))
    if sum(map(area, loops)) < 0:  # bubbles in a full box
        loops.append(corners)
    return loops


def wall_caps(points, facets, lower, upper):
    """Where the liquid touches a wall of the box its surface is open. Yields for each such
    wall the polygons (k x 3) that close it."""
    edges = numpy.concatenate([facets[:, [0, 1]], facets[:, [1, 2]], facets[:, [2, 0]]])
    n = len(points)
    edges = edges[~numpy.isin(edges @ [n, 1], edges @ [1, n])]  # no triangle beyond
    tolerance = 1e-5 * (upper - lower).max()
    for axis in range(3):
        for wall, order in (lower[axis], (2, 1)), (upper[axis], (1, 2)):
            on_wall = (abs(points[edges, axis] - wall) < tolerance).all(axis=1)
            # seen from outside, the cap's edges run against the surface's
            plane = [(axis + k) % 3 for k in order]
            caps = []
            for loop in liquid_loops(points[:, plane], edges[on_wall][:, ::-1],
                                     lower[plane], upper[plane]):
                caps.append(numpy.full((len(loop), 3), wall))
                caps[-1][:, plane] = loop
            if caps:
                yield caps


def outline_of(run, frame):
    """The liquid_loops of a frame of a Run in two dimensions."""
    surface = run.surface(frame)
    return liquid_loops(surface.points[:, :2], surface.facets, run.lower, run.upper)


def area(loop):
    """Of a polygon (k x 2), positive if it is counter-clockwise."""
    x, y = loop.T
    return 0.5 * numpy.sum(x * numpy.roll(y, -1) - y * numpy.roll(x, -1))


def _perimeter(point, lower, size):
    """Where the rectangle's boundary is next to the point, from 0 to 4 counter-clockwise."""
    x, y = numpy.clip((point - lower) / size, 0, 1)
    side = int(numpy.argmin([y, 1 - x, 1 - y, x]))
    return side + (x, y, 1 - x, 1 - y)[side]
