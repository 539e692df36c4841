// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/dynamics/surface_weight.h>
#include <treacle/mesh/locator.h>
#include <treacle/mesh/surface_size.h>

namespace treacle
{
  namespace
  {
    /// Of the weight gained in a step. From a half on any step is stable; a surface that does not
    /// feel inertia forgets a disturbance by the factor 0.58 a step then, or faster.
    constexpr double part_of_gain = 0.75;
    /// g dt^2 over the finest leaf, up to which nothing is needed.
    constexpr double longest_without = 3;

    /// The mean over the cells of a node, by their liquid; 0 without any.
    template <int dim>
    double
    density_at_node(const LiquidDomain<dim> &domain, const LocalIndex node)
    {
      const Mesh<dim> &mesh = domain.mesh;
      double           mass = 0, volume = 0;
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        {
          const LocalIndex c = mesh.node_cells[k];
          mass += domain.density[c] * domain.liquid_volume[c];
          volume += domain.liquid_volume[c];
        }
      return volume > 0 ? mass / volume : 0.;
    }

    /// Integrals at nodes that are summed over ranks.
    template <int dim>
    class NodeTensors
    {
    public:
      static constexpr unsigned int n = SymmetricTensor<2, dim>::n_independent_components;

      explicit NodeTensors(const Mesh<dim> &mesh)
      {
        for (Vector &v : values)
          v = mesh.zeros(mesh.nodes);
      }

      void
      add(const LocalIndex node, const SymmetricTensor<2, dim> &value)
      {
        for (unsigned int i = 0; i < n; ++i)
          values[i].local_element(node) += value.access_raw_entry(i);
      }

      void
      sum_over_ranks()
      {
        for (Vector &v : values)
          v.compress(VectorOperation::add);
      }

      SymmetricTensor<2, dim>
      operator[](const LocalIndex node) const
      {
        SymmetricTensor<2, dim> result;
        for (unsigned int i = 0; i < n; ++i)
          result.access_raw_entry(i) = values[i].local_element(node);
        return result;
      }

    private:
      std::array<Vector, n> values;
    };
  } // namespace

  namespace
  {
    /// What a unit of density and area at a vertex of the surface weighs more, or not less, for each
    /// length that it moves on by along the normal (m/s^2); 0 where the step is short enough.
    template <int dim>
    double
    gain_at_vertex(const State<dim>                    &state,
                   const LiquidDomain<dim>             &domain,
                   const typename Surface<dim>::Vertex &vertex,
                   const Point<dim>                    &x,
                   const Tensor<1, dim>                &normal,
                   const double                         dt)
    {
      const auto &[a, b, t] = vertex;
      if ((1 - t) * domain.solid_distance[a] + t * domain.solid_distance[b] < 0)
        return 0;
      const Tensor<1, dim> g       = domain.scene.gravity(x, state.time);
      const double         g_dt2   = g.norm() * dt * dt;
      if (g_dt2 <= longest_without * domain.mesh.finest_size())
        return 0;
      const double longest =
        longest_without *
        surface_size_of_cell(domain.mesh, domain.mesh.locator().locate_here(x).cell);
      if (g_dt2 <= longest)
        return 0;
      const NodeVector<dim> &v = state.v, &before = *state.before->v;
      const Tensor<1, dim>   change =
        (1 - t) * (v.value(a) - before.value(a)) + t * (v.value(b) - before.value(b));
      return part_of_gain * (1 - std::pow(longest / g_dt2, 2)) *
             std::max(0., (change / dt - g) * normal);
    }
  } // namespace

  template <int dim>
  typename NodeSystem<dim>::Springs
  surface_weight(const State<dim>         &state,
                 const LiquidDomain<dim>  &domain,
                 const Surface<dim>       &surface,
                 const BackwardDifference &difference)
  {
    const Mesh<dim> &mesh = domain.mesh;
    if (!state.before || !state.before->v)
      return {};
    NodeTensors<dim> gain(mesh); // over the density
    std::string      error;
    for (unsigned int k = 0; k < surface.facets.size(); ++k)
      {
        const Tensor<1, dim> area = area_vector<dim>(surface.facet_points(k));
        if (area.norm() == 0)
          continue;
        const Tensor<1, dim> n = area / area.norm();
        for (const unsigned int i : surface.facets[k])
          keep_error(error, [&] {
            const auto                   &vertex = surface.vertices[i];
            const SymmetricTensor<2, dim> added =
              gain_at_vertex(state, domain, vertex, surface.positions[i], n, difference.dt) *
              difference.step * difference.dt * area.norm() / dim * symmetrize(outer_product(n, n));
            gain.add(vertex.a, (1 - vertex.t) * added);
            gain.add(vertex.b, vertex.t * added);
          });
      }
    throw_first(mesh.communicator(), error);
    gain.sum_over_ranks();

    typename NodeSystem<dim>::Springs springs{
      std::vector<SymmetricTensor<2, dim>>(mesh.n_owned_nodes()),
      std::vector<Tensor<1, dim>>(mesh.n_owned_nodes())};
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        springs.strength[node] = density_at_node(domain, node) * gain[node];
        springs.pull[node]     = springs.strength[node] * state.before->v->value(node);
      }
    return springs;
  }

  template NodeSystem<2>::Springs
  surface_weight(const State<2> &,
                 const LiquidDomain<2> &,
                 const Surface<2> &,
                 const BackwardDifference &);
  template NodeSystem<3>::Springs
  surface_weight(const State<3> &,
                 const LiquidDomain<3> &,
                 const Surface<3> &,
                 const BackwardDifference &);
} // namespace treacle
