// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/expression.h>
#include <treacle/mesh/octree_parameters.h>

#include <cmath>

namespace treacle
{
  template <int dim>
  double
  OctreeParameters<dim>::shortest_edge() const
  {
    const Tensor<1, dim> edge     = upper_corner - lower_corner;
    double               shortest = edge[0];
    for (unsigned int d = 1; d < dim; ++d)
      shortest = std::min(shortest, edge[d]);
    return shortest;
  }

  template <int dim>
  std::vector<unsigned int>
  OctreeParameters<dim>::root_counts() const
  {
    const double              s = shortest_edge() / root_cells;
    std::vector<unsigned int> n(dim);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double edge = upper_corner[d] - lower_corner[d];
        n[d]              = static_cast<unsigned int>(std::lround(edge / s));
        require(std::abs(edge / s - n[d]) < 1e-6,
                "Domain: cubes cannot tile the box. With Mesh/Root cells = " +
                  std::to_string(root_cells) + " a root cube has the edge " + digits(s) +
                  " m, and edge " + std::to_string(d + 1) + " of the box is " +
                  digits(edge / s) +
                  " cubes long. Change the corners, or raise Root cells until every "
                  "edge is a whole number of cubes.");
      }
    return n;
  }

  template <int dim>
  void
  OctreeParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter("Root cells",
                      root_cells,
                      "Cubes along the shortest edge of the box at level 0.",
                      Patterns::Integer(1, 1000));
    prm.add_parameter("Surface level",
                      surface_level,
                      "Level of the leaves in a band around the surface; a leaf "
                      "of level l has the edge: shortest box edge / (Root cells "
                      "* 2^l).",
                      Patterns::Integer(1, 18));
    prm.add_parameter("Interior level",
                      interior_level,
                      "Smallest level of leaves inside the liquid.",
                      Patterns::Integer(0, 18));
    prm.add_parameter("Air level",
                      air_level,
                      "Smallest level of leaves anywhere.",
                      Patterns::Integer(0, 18));
    prm.add_parameter("Band width",
                      band_width,
                      "Number of leaves inside the surface that are as fine as those on it.",
                      Patterns::Integer(1, 20));
    prm.add_parameter("Air band width",
                      air_band_width,
                      "The same outside of the surface; where it moves, a new mesh is fine ahead "
                      "of it too.",
                      Patterns::Integer(1, 20));
    add_sizes(prm);
    prm.leave_subsection();
  }

  template <int dim>
  void
  OctreeParameters<dim>::add_sizes(ParameterHandler &prm)
  {
    prm.add_parameter("Coarsest surface level",
                      coarsest_surface_level,
                      "Level of the leaves around the surface where it is smooth, and liquid and "
                      "gaps are thick; all of the surface has the Surface level if that is not "
                      "larger.",
                      Patterns::Integer(0, 18));
    prm.add_parameter("Leaves per radius",
                      leaves_per_radius,
                      "Between the two surface levels leaves are so small that a radius of curvature "
                      "has as many; 0: curvature asks for nothing.",
                      Patterns::Double(0, 100));
    prm.add_parameter("Leaves across",
                      leaves_across,
                      "Between the two surface levels leaves are so small that as many lie across "
                      "liquid, or a gap between liquid; 0: thickness asks for nothing.",
                      Patterns::Double(0, 10));
    prm.add_parameter("Size",
                      size,
                      "Largest edge (m) of leaves in the liquid and along the surface, down to those of "
                      "the Surface level; a formula in " +
                        std::string(dim == 2 ? "x,y,t" : "x,y,z,t") +
                        ", taken at the centres of leaves and of their children. Empty: any.");
    prm.add_parameter("Fine at jumps",
                      fine_at_jumps,
                      "Whether leaves are of the Surface level where the viscosity of the liquid jumps: where "
                      "it is 1.5 times as large beside a leaf; between advected materials, at t = 0 if they differ at "
                      "all, later by 1.5 times or a quarter of all that there is.");
    prm.add_parameter("Velocity error",
                      velocity_error,
                      "Leaves in the liquid, down to those of the Surface level, are so small that others twice as "
                      "large would change the velocity by this part of the largest speed, from the second step on, where Steps/Surface is on; "
                      "0: it asks for nothing.",
                      Patterns::Double(0, 1));
    prm.add_parameter("Maximum cells",
                      maximum_cells,
                      "Where the surface asks for more cells, about, it gets larger leaves than it asks for, "
                      "everywhere in proportion, down to the Coarsest surface level, but not what is asked for "
                      "in the liquid; 0: any number.",
                      Patterns::Integer(0));
  }

  template <int dim>
  void
  OctreeParameters<dim>::check() const
  {
    for (const unsigned int n : root_counts())
      require(
        static_cast<double>(n) * (2 << surface_level) < (1 << 21),
        "Mesh/Surface level and Mesh/Root cells: more than 2^20 leaves along an edge "
        "of the box; lower one of them.");
    require(interior_level <= surface_level && air_level <= surface_level,
            "Mesh/Interior level and Mesh/Air level must not be larger than Mesh/Surface "
            "level.");
    require(maximum_cells == 0 || coarsest_surface_level < surface_level,
            "Mesh/Maximum cells needs a Mesh/Coarsest surface level below Mesh/Surface level: all of the "
            "surface has leaves of one size.");
    if (!size.empty())
      Expression<dim>(size, "Mesh/Size", true);
  }

  template <int dim>
  double
  OctreeParameters<dim>::finest_size() const
  {
    return std::ldexp(shortest_edge() / root_cells, -static_cast<int>(surface_level));
  }

  template <int dim>
  unsigned int
  OctreeParameters<dim>::level_of(const double size) const
  {
    // from the finest on: along most of a surface that is the answer
    unsigned int level = surface_level;
    for (double edge = 2 * finest_size(); level > 0 && edge <= size * (1 + 1e-9); edge *= 2)
      --level;
    return level;
  }

  template struct OctreeParameters<2>;
  template struct OctreeParameters<3>;
} // namespace treacle
