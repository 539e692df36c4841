// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/moved_points.h>
#include <treacle/surface/marker_motion.h>

namespace treacle
{
  namespace
  {
    /// Nodal gradients of the velocity, evaluated at points: [point * dim * dim + component
    /// * dim + direction].
    template <int dim>
    std::vector<double>
    velocity_gradients(const Mesh<dim>               &mesh,
                       const NodeVector<dim>         &velocity,
                       const std::vector<Point<dim>> &x,
                       Guesses                       &guesses)
    {
      const auto mean = means_at_nodes(mesh, [&](const LocalIndex c) { return velocity_gradient(mesh, c, velocity); });
      std::vector<NodeVector<dim>> gradients;
      gradients.reserve(dim); // a vector of them that grows would lose their ghosts
      for (unsigned int d = 0; d < dim; ++d)
        {
          gradients.emplace_back(mesh.nodes);
          for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
            gradients[d].set(node, mean[node][d]);
          gradients[d].update_ghost_values();
        }
      std::vector<NodeField<dim>> fields;
      for (const NodeVector<dim> &gradient : gradients)
        for (const Vector &component : gradient.component)
          fields.push_back({&component});
      return Tracer<dim>(mesh).evaluate(x, fields, guesses);
    }

    /// dn/dt = -(grad u)^T n by the implicit midpoint rule; the length does not matter.
    template <int dim>
    Tensor<1, dim>
    turned(const Tensor<1, dim> &old, const double *gradient, const double dt)
    {
      Tensor<2, dim> half;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          half[j][i] = 0.5 * dt * gradient[i * dim + j];
      const Tensor<1, dim> normal =
        invert(Tensor<2, dim>(unit_symmetric_tensor<dim>()) + half) * (old - half * old);
      const double length = normal.norm();
      return std::isfinite(length) && length > 0 ? normal / length : old;
    }
  } // namespace

  template <int dim>
  std::vector<Marker<dim>>
  moved_markers(const State<dim> &state, const VelocityInStep<dim> &velocity, const double dt)
  {
    const Mesh<dim> &mesh = *state.mesh;
    if (Utilities::MPI::max<unsigned int>(state.markers.size(), mesh.communicator()) == 0)
      return {};
    const std::vector<Point<dim>> from = positions(state.markers);
    Guesses guesses;
    const std::vector<Point<dim>> to = Tracer<dim>(mesh).trace(from, velocity, dt, guesses);
    std::vector<Point<dim>>       middle(from.size());
    for (unsigned int k = 0; k < from.size(); ++k)
      middle[k] = from[k] + 0.5 * (to[k] - from[k]);
    const std::vector<double> gradients = velocity_gradients(mesh, *velocity.after[2], middle, guesses);
    std::vector<Marker<dim>>  moved(from.size());
    for (unsigned int k = 0; k < from.size(); ++k)
      moved[k] = {to[k], turned(state.markers[k].normal, &gradients[k * dim * dim], dt)};
    return moved;
  }

  template <int dim>
  std::vector<MaterialPoint<dim>>
  moved_material(const State<dim> &state, const VelocityInStep<dim> &velocity, const double dt)
  {
    std::vector<MaterialPoint<dim>> moved = state.material->points;
    const auto ends = Tracer<dim>(*state.mesh).trace(positions(moved), velocity, dt);
    for (unsigned int k = 0; k < moved.size(); ++k)
      moved[k].position = ends[k];
    return moved;
  }

  template <int dim>
  std::vector<Parcel<dim>>
  moved_parcels(const LiquidDomain<dim> &domain, const VelocityInStep<dim> &velocity, const double dt)
  {
    std::vector<Parcel<dim>> moved;
    Guesses                  cells;
    for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
      if (domain.liquid_volume[c] > 0)
        {
          moved.push_back({domain.liquid_centre[c], domain.liquid_volume[c]});
          cells.push_back(c);
        }
    const auto ends = Tracer<dim>(domain.mesh).path_ends(positions(moved), velocity, dt, cells);
    for (unsigned int k = 0; k < moved.size(); ++k)
      moved[k].position = ends[k];
    return moved;
  }

  template std::vector<Parcel<2>>
  moved_parcels(const LiquidDomain<2> &, const VelocityInStep<2> &, const double);
  template std::vector<Parcel<3>>
  moved_parcels(const LiquidDomain<3> &, const VelocityInStep<3> &, const double);
  template std::vector<MaterialPoint<2>>
  moved_material(const State<2> &, const VelocityInStep<2> &, const double);
  template std::vector<MaterialPoint<3>>
  moved_material(const State<3> &, const VelocityInStep<3> &, const double);
  template std::vector<Marker<2>>
  moved_markers(const State<2> &, const VelocityInStep<2> &, const double);
  template std::vector<Marker<3>>
  moved_markers(const State<3> &, const VelocityInStep<3> &, const double);
} // namespace treacle
