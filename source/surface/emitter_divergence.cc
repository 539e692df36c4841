// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/face_opening.h>
#include <treacle/geometry/cut_simplex.h>
#include <treacle/surface/emitter_divergence.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    class EmitterDivergence
    {
    public:
      /// With solids where they are at the end of a step, emitters at a @p time in it. Refers to all.
      EmitterDivergence(const MeshData<dim> &data, const std::vector<double> &to_emitters, const double end, const double time)
        : mesh(data.mesh)
        , scene(data.scene)
        , end(end)
        , time(time)
        , to_solids(data.solid_distance(end))
        , to_emitters(to_emitters)
        , opening(mesh, scene, to_solids, to_emitters, time)
      {}

      /// m^dim/s.
      double
      in_cell(const LocalIndex c) const
      {
        const auto any = [&](const auto &is) { return std::any_of(mesh.cell_nodes[c].begin(), mesh.cell_nodes[c].end(), is); };
        if (!any([this](const LocalIndex node) { return to_emitters[node] <= 0 && to_solids[node] > 0; }))
          return 0;
        const bool is_open = any([this](const LocalIndex node) { return to_emitters[node] > 0 && to_solids[node] > 0; }),
                   is_cut  = any([this](const LocalIndex node) { return to_solids[node] <= 0; });
        Flow flow;
        for (const LocalIndex f : mesh.cell_faces[c])
          add(flow, f, c);
        double made = is_open || std::abs(flow.outflow) < rounding * flow.size ? 0 : flow.outflow;
        if (is_cut)
          {
            const Point<dim>     x = on_wall(c);
            const Tensor<1, dim> v = scene.emitter_velocity(x, time), pushed = v - scene.solid_velocity(x, end);
            if (!is_open)
              made += flow.wall * v - std::max(0., flow.wall * pushed);
            else if (flow.wall * pushed > glancing * flow.wall.norm() * pushed.norm())
              made -= std::max(0., flow.in_solids);
          }
        return made - flow.through_sides;
      }

    private:
      static constexpr double rounding = 1e-12, glancing = 0.1;

      /// What the emitter's velocity carries out of a cell (m^dim/s).
      struct Flow
      {
        double         outflow = 0, size = 0; ///< through faces outside solids, and what goes in and out
        double         in_solids     = 0; ///< through parts of faces there that are poured nevertheless
        double         through_sides = 0; ///< of the box, no inflow
        Tensor<1, dim> wall;              ///< of solids: its area vector
      };

      /// Through a face of a cell.
      void
      add(Flow &flow, const LocalIndex f, const LocalIndex c) const
      {
        std::array<Point<dim>, dim> x;
        VertexValues<dim - 1>       in_solids, filled;
        for (unsigned int i = 0; i < dim; ++i)
          {
            const LocalIndex node = mesh.face_nodes[f][i];
            x[i]                  = mesh.node_position[node];
            in_solids[i]          = -to_solids[node];
            filled[i]             = std::max(to_emitters[node], in_solids[i]);
          }
        const Tensor<1, dim> area = (mesh.face_cells[f][0] == c ? 1 : -1) * mesh.face_area[f] * mesh.face_normal[f];
        const double         open = negative_fraction<dim - 1>(in_solids),
                             across = area * scene.emitter_velocity(negative_centroid<dim>(x, in_solids), time);
        flow.wall -= open * area;
        flow.outflow += open * across;
        flow.size += std::abs(across);
        flow.in_solids += opening.poured_in_solids(f) * across;
        if (mesh.face_side[f] != Mesh<dim>::no_side)
          flow.through_sides += std::max(0., across) * negative_fraction<dim - 1>(filled);
      }

      /// Amid the wall of solids in a cell.
      Point<dim>
      on_wall(const LocalIndex c) const
      {
        const Simplex<dim>      x        = mesh.cell_vertices(c);
        const VertexValues<dim> distance = mesh.values(c, to_solids);
        Tensor<1, dim>          sum;
        unsigned int            n = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          for (unsigned int j = 0; j <= dim; ++j)
            if (distance[i] <= 0 && distance[j] > 0)
              {
                sum += (distance[j] * x[i] - distance[i] * x[j]) / (distance[j] - distance[i]);
                ++n;
              }
        return Point<dim>(sum / n);
      }

      const Mesh<dim>           &mesh;
      const Scene<dim>          &scene;
      const double               end, time;
      const std::vector<double> &to_solids, &to_emitters; ///< of nodes (m)
      const FaceOpening<dim>     opening;
    };
  } // namespace

  template <int dim>
  std::vector<Parcel<dim>>
  made_in_emitters(const MeshData<dim>       &data,
                   const std::vector<double> &to_emitters,
                   const double               end,
                   const double               time,
                   const double               dt)
  {
    const EmitterDivergence<dim> made(data, to_emitters, end, time);
    std::vector<Parcel<dim>>     parcels;
    std::string                  error;
    keep_error(error, [&] {
      for (LocalIndex c = 0; c < data.mesh.n_owned_cells(); ++c)
        if (const double rate = made.in_cell(c); rate != 0)
          parcels.push_back({barycentre<dim>(data.mesh.cell_vertices(c)), dt * rate});
    });
    throw_first(data.mesh.communicator(), error);
    return parcels;
  }

  template std::vector<Parcel<2>>
  made_in_emitters(const MeshData<2> &, const std::vector<double> &, const double, const double, const double);
  template std::vector<Parcel<3>>
  made_in_emitters(const MeshData<3> &, const std::vector<double> &, const double, const double, const double);
} // namespace treacle
