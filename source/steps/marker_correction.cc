// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/near_ranks.h>
#include <treacle/steps/marker_correction.h>
#include <treacle/steps/redistance.h>
#include <treacle/steps/smooth_level_set.h>

namespace treacle
{
  template <int dim>
  std::vector<Marker<dim>>
  moved_markers(const State<dim> &state, const NodeVector<dim> &velocity, const double dt)
  {
    const Mesh<dim>              &mesh = *state.mesh;
    const Tracer<dim>             tracer(mesh);
    const std::vector<Point<dim>> from = positions(state.markers);
    const std::vector<Point<dim>> to   = tracer.trace(from, velocity, dt);

    std::vector<NodeVector<dim>> gradients;
    for (const Vector &component : velocity.component)
      gradients.push_back(nodal_gradient(mesh, component));
    std::vector<NodeField<dim>> fields;
    for (const NodeVector<dim> &gradient : gradients)
      for (const Vector &component : gradient.component)
        fields.push_back({&component});
    std::vector<Point<dim>> middle(from.size());
    for (unsigned int k = 0; k < from.size(); ++k)
      middle[k] = from[k] + 0.5 * (to[k] - from[k]);
    const std::vector<double> numbers = tracer.evaluate(middle, fields);

    std::vector<Marker<dim>> moved(from.size());
    for (unsigned int k = 0; k < from.size(); ++k)
      {
        // dn/dt = -(grad u)^T n, and the length does not matter
        Tensor<1, dim> normal = state.markers[k].normal;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            normal[j] -= dt * numbers[(k * dim + i) * dim + j] * state.markers[k].normal[i];
        moved[k] = {to[k], normal / normal.norm()};
      }
    return moved;
  }

  namespace
  {
    /// A marker and phi at it.
    template <int dim>
    struct Record
    {
      Marker<dim> marker;
      double      phi;
    };

    /// Markers of this rank, and of others within a margin of its leaves, by finest cube.
    template <int dim>
    class NearMarkers
    {
    public:
      NearMarkers(const State<dim> &state, const double reach)
        : octree(state.mesh->octree())
        , reach(reach)
      {
        const MPI_Comm           &comm = octree.communicator();
        const NearRanks<dim>      near(octree, reach);
        const std::vector<double> phi =
          SmoothLevelSet<dim>(*state.mesh, state.phi).values(positions(state.markers));
        PerRank<std::array<double, 2 * dim + 1>> to_rank(near.n_ranks());
        for (unsigned int k = 0; k < state.markers.size(); ++k)
          {
            const Marker<dim> &marker = state.markers[k];
            records.push_back({marker, phi[k]});
            near.for_each({{marker.position, marker.position}}, [&](const unsigned int r) {
              const auto numbers = marker.numbers();
              to_rank[r].emplace_back();
              std::copy(numbers.begin(), numbers.end(), to_rank[r].back().begin());
              to_rank[r].back().back() = phi[k];
            });
          }
        for (const auto &received : send_and_receive(comm, to_rank))
          for (const auto &numbers : received)
            records.push_back({Marker<dim>::from(numbers.data()), numbers.back()});
        sort_into_cubes();
      }

      /// Markers closer than the reach.
      void
      around(const Point<dim> &x, std::vector<const Record<dim> *> &result) const
      {
        result.clear();
        Point<dim> lower = x, upper = x;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] -= reach;
            upper[d] += reach;
          }
        const LatticePoint<dim> first = octree.finest_cube(lower), last = octree.finest_cube(upper);
        for (LatticePoint<dim> cube = first; cube[dim - 1] <= last[dim - 1];)
          {
            if (const auto found = cubes.find(pack<dim>(cube)); found != cubes.end())
              for (unsigned int k = found->second.first; k < found->second.second; ++k)
                if ((records[k].marker.position - x).norm_square() < reach * reach)
                  result.push_back(&records[k]);
            for (unsigned int d = 0; d < dim; ++d)
              {
                cube[d] += 2;
                if (cube[d] <= last[d] || d == dim - 1)
                  break;
                cube[d] = first[d];
              }
          }
      }

    private:
      void
      sort_into_cubes()
      {
        std::vector<std::pair<VertexKey, unsigned int>> order;
        for (unsigned int k = 0; k < records.size(); ++k)
          order.emplace_back(pack<dim>(octree.finest_cube(records[k].marker.position)), k);
        std::sort(order.begin(), order.end());
        std::vector<Record<dim>> sorted;
        sorted.reserve(records.size());
        for (const auto &[key, k] : order)
          {
            const unsigned int at = sorted.size();
            cubes.emplace(key, std::make_pair(at, at)).first->second.second = at + 1;
            sorted.push_back(records[k]);
          }
        records = std::move(sorted);
      }

      const Octree<dim>                                                        &octree;
      const double                                                              reach;
      std::vector<Record<dim>>                                                  records;
      std::unordered_map<VertexKey, std::pair<unsigned int, unsigned int>> cubes;
    };

    /// phi at a node from the markers around it; @p old is what it was.
    template <int dim>
    double
    corrected(const Point<dim>                       &x,
              const double                            old,
              const std::vector<const Record<dim> *> &near,
              const double                            reach)
    {
      static const int mode = std::getenv("MODE") ? atoi(std::getenv("MODE")) : 3;
      const auto squared = [&](const Record<dim> *r) {
        return (r->marker.position - x).norm_square();
      };
      const Tensor<1, dim> facing =
        (*std::min_element(near.begin(), near.end(), [&](const auto *a, const auto *b) {
          return squared(a) < squared(b);
        }))->marker.normal;
      bool           opposed = false;
      double         sum = 0, residual = 0;
      Tensor<1, dim> mean;
      for (const Record<dim> *r : near)
        {
          const double same = r->marker.normal * facing;
          opposed           = opposed || same < -0.3;
          if (mode != 1 && same <= 0)
            continue;
          const double w = std::pow(1 - squared(r) / (reach * reach), 2);
          sum += w;
          residual += w * r->phi;
          mean += w * r->marker.normal;
        }
      if (mode == 1 || mode == 2 || (mode == 3 && !opposed))
        return old - residual / sum;
      // distance from planes; with the mean of two normals it is exact on a sphere
      mean /= mean.norm();
      double distance = 0;
      for (const Record<dim> *r : near)
        if (r->marker.normal * facing > 0)
          distance += std::pow(1 - squared(r) / (reach * reach), 2) * 0.5 *
                      ((x - r->marker.position) * (r->marker.normal + mean));
      return distance / sum;
    }
  } // namespace

  template <int dim>
  void
  correct_by_markers(State<dim> &state)
  {
    const Mesh<dim>       &mesh  = *state.mesh;
    static const double fac = std::getenv("REACH") ? atof(std::getenv("REACH")) : 1.25;
    const double           reach = fac * mesh.finest_size();
    const NearMarkers<dim> markers(state, reach);
    std::vector<const Record<dim> *> near;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double &phi = state.phi.local_element(node);
        if (std::abs(phi) > 3 * mesh.finest_size())
          continue;
        markers.around(mesh.node_position[node], near);
        if (!near.empty())
          phi = corrected(mesh.node_position[node], phi, near, reach);
      }
    state.phi.update_ghost_values();
  }

#define INSTANTIATE(dim)                                                                      \
  template std::vector<Marker<dim>> moved_markers(                                            \
    const State<dim> &, const NodeVector<dim> &, const double);                               \
  template void correct_by_markers(State<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
