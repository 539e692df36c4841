// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// What a step does, counted: a drop in a bowl, in flight and when it lies there (the scene of
// prm/benchmarks/bowl.prm, coarse), and a cone in flight, whose leaves Maximum cells bounds. A slip in
// speed shows here without a clock.

#include "../run_scene.h"
#include "../tests.h"

#include <treacle/base/work.h>

namespace tests::scenes_work
{
void
count(const MPI_Comm &comm, const std::string &name, const std::string &scene, const unsigned int n_solids)
{
  const Work before = Work::here();
  const auto rows   = run_scene<3>(
    comm,
    "set End time = 0.06\nset Frame interval = 0.01\n"
      "subsection Material\nset Density = 1\nset Viscosity = 1\nend\n" + scene,
    n_solids);
  const Work   after = Work::here();
  const double steps = rows.size() - 1, cells = rows.back().at("Cells");
  out() << name << ", a step: " << std::setprecision(2)
        << (after.cells_made - before.cells_made) / cells / steps << " meshes; a cell and step: "
        << (after.points_located - before.points_located) / cells / steps << " points located, "
        << (after.facets_tried - before.facets_tried) / cells / steps << " facets tried; a step: "
        << (after.products - before.products) / steps << " products, "
        << (after.preconditionings - before.preconditionings) / steps << " preconditionings, "
        << (after.preconditioners_made - before.preconditioners_made) / steps
        << " preconditioners made" << std::endl;
}

std::string
drop_in_bowl(const double height)
{
  return "subsection Mesh\nset Surface level = 4\nset Interior level = 3\nend\n"
         "subsection Liquid 1\nset Centre = 0.5, 0.5, " +
         std::to_string(height) +
         "\nset Radius = 0.2\nend\nsubsection Solid 1\nset Shape = expression\n"
         "set Expression = 0.35 - sqrt((x-0.5)^2 + (y-0.5)^2 + (z-0.5)^2)\nend\n";
}

/// Its tip is finer than its base, and it lies askew to the leaves.
std::string
cone_in_few_cells()
{
  const std::string along = "((x-0.5)*0.6 + (z-0.6)*0.8)";
  return "subsection Mesh\nset Surface level = 6\nset Coarsest surface level = 4\nset Interior level = 3\n"
         "set Maximum cells = 40000\nend\nsubsection Liquid 1\nset Shape = expression\n"
         "set Expression = max(0.97*(sqrt(max((x-0.5)^2 + (y-0.5)^2 + (z-0.6)^2 - " + along +
         "^2, 0)) - 0.25*(0.3-" + along + ")), abs(" + along + ") - 0.28)\nend\n";
}

void
start(int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      return; // what others know is located twice
    count(comm, "in flight", drop_in_bowl(0.5), 1);
    count(comm, "at rest", drop_in_bowl(0.36), 1);
    count(comm, "a cone in few cells, in flight", cone_in_few_cells(), 0);
  });
}

const Test test("scenes/work", start);
} // namespace tests::scenes_work
