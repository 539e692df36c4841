// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/meeting_solids.h>
#include <treacle/geometry/wall_part.h>
#include <treacle/scene/bodies.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    template <int dim>
    struct SolidInCell
    {
      unsigned int      index;
      VertexValues<dim> depth; ///< at the vertices (m)
    };

    /// The solids that a simplex touches, and those that are the nearest ones to its vertices.
    template <int dim>
    std::vector<SolidInCell<dim>>
    solids_in(const Simplex<dim> &x, const Scene<dim> &scene, const double time)
    {
      std::vector<SolidInCell<dim>> solids;
      VertexValues<dim>             deepest;
      deepest.fill(-far_away);
      for (unsigned int k = 0; k < scene.n_solids(); ++k)
        {
          solids.push_back({k, {}});
          for (unsigned int i = 0; i <= dim; ++i)
            {
              solids[k].depth[i] = -scene.solid_distance(k, x[i], time);
              deepest[i]         = std::max(deepest[i], solids[k].depth[i]);
            }
        }
      const auto is_far = [&](const SolidInCell<dim> &solid) {
        return std::equal(solid.depth.begin(), solid.depth.end(), deepest.begin(), [](const double depth, const double most) {
          return depth < 0 && depth < most;
        });
      };
      solids.erase(std::remove_if(solids.begin(), solids.end(), is_far), solids.end());
      return solids;
    }

    /// As far as vertices of the simplex tell.
    template <int dim>
    bool
    move_alike(const std::vector<SolidInCell<dim>> &solids, const Simplex<dim> &x, const Scene<dim> &scene, const double time)
    {
      constexpr double alike = 1e-6; // velocities from positions are differences
      double           difference = 0, largest = 0;
      for (const Point<dim> &vertex : x)
        {
          const Tensor<1, dim> first = scene.solid_velocity(solids.front().index, vertex, time);
          for (const SolidInCell<dim> &solid : solids)
            {
              const Tensor<1, dim> velocity = scene.solid_velocity(solid.index, vertex, time);
              difference                    = std::max(difference, (velocity - first).norm());
              largest                       = std::max(largest, velocity.norm());
            }
        }
      return difference <= alike * largest;
    }
  } // namespace

  template <int dim>
  std::optional<double>
  swept_by_meeting_solids(const Mesh<dim>         &mesh,
                          const Scene<dim>        &scene,
                          const LocalIndex         cell,
                          const VertexValues<dim> &values,
                          const double             time)
  {
    const Simplex<dim>                  x      = mesh.cell_vertices(cell);
    const std::vector<SolidInCell<dim>> solids = solids_in<dim>(x, scene, time);
    if (solids.size() < 2 || move_alike<dim>(solids, x, scene, time))
      return {};
    double swept = 0;
    for (const SolidInCell<dim> &solid : solids)
      {
        VertexValues<dim> counts = values;
        for (const SolidInCell<dim> &other : solids)
          if (other.index != solid.index)
            std::transform(counts.begin(), counts.end(), other.depth.begin(), counts.begin(), [](const double a, const double b) {
              return std::max(a, b);
            });
        const WallPart<dim> wall = wall_part<dim>(x, solid.depth, counts);
        swept += scene.solid_velocity(solid.index, wall.centre, time) * wall.area;
      }
    return swept;
  }

  template std::optional<double>
  swept_by_meeting_solids(const Mesh<2> &, const Scene<2> &, const LocalIndex, const VertexValues<2> &, const double);
  template std::optional<double>
  swept_by_meeting_solids(const Mesh<3> &, const Scene<3> &, const LocalIndex, const VertexValues<3> &, const double);
} // namespace treacle
