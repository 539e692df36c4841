# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Parts of a mesh to be drawn. A container from a file is no box that the surface could be
closed along: there the liquid is drawn by triangles."""

import numpy


def wet_polygons(points, cells, phi):
    """The parts of triangles where the level set is negative."""
    for cell in cells:
        polygon = []
        for a, b in zip(cell, numpy.roll(cell, -1)):
            if phi[a] < 0:
                polygon.append(points[a])
            if (phi[a] < 0) != (phi[b] < 0):
                t = phi[a] / (phi[a] - phi[b])
                polygon.append(points[a] + t * (points[b] - points[a]))
        if polygon:
            yield numpy.array(polygon)


def walls(points, cells):
    """Edges of one triangle only, as pairs of points."""
    edges = numpy.sort(numpy.concatenate([cells[:, [0, 1]], cells[:, [1, 2]], cells[:, [2, 0]]]))
    edges, counts = numpy.unique(edges, axis=0, return_counts=True)
    return points[edges[counts == 1]]


def weld(points, cells):
    """Without the copies of points that each rank's piece has."""
    points, index = numpy.unique(points, axis=0, return_inverse=True)
    return points, index.reshape(-1)[cells]


def boundary_faces(points, cells):
    """Faces (n x 3 points) that belong to one cell only, and that cell. The points may
    be repeated from cell to cell."""
    _, label = numpy.unique(points.astype("f4"), axis=0, return_inverse=True)
    faces = numpy.concatenate([numpy.delete(cells, k, axis=1) for k in range(4)])
    _, first, count = numpy.unique(numpy.sort(label[faces], axis=1), axis=0,
                                   return_index=True, return_counts=True)
    alone = first[count == 1]
    return faces[alone], alone % len(cells)
