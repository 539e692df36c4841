// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/maximum.h>
#include <treacle/dynamics/measures.h>
#include <treacle/fields/strain_rate.h>

namespace treacle
{
  namespace
  {
    /// What is summed over ranks; doubles only, so that one call does it.
    template <int dim>
    struct Sums
    {
      double volume = 0, mass = 0;
      std::array<double, dim>
                  first_moment{}; // about the box's centre, as the momenta are
      double      potential_energy = 0, dissipation = 0;
      Motion<dim> of_faces, of_nodes;
    };

    /// Extents as maxima: of -x and x, and of the speed.
    template <int dim>
    using Maxima = std::array<double, 2 * dim + 1>;

    template <int dim>
    void
    add_moment(std::array<double, Motion<dim>::n_rotations> &sum,
               const Tensor<1, dim>                         &arm,
               const Tensor<1, dim>                         &momentum)
    {
      if constexpr (dim == 2)
        sum[0] += arm[0] * momentum[1] - arm[1] * momentum[0];
      else
        for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int i = (d + 1) % 3, j = (d + 2) % 3;
            sum[d] += arm[i] * momentum[j] - arm[j] * momentum[i];
          }
    }

    template <int dim>
    void
    add_momentum(Motion<dim>          &sum,
                 const Tensor<1, dim> &arm,
                 const Tensor<1, dim> &momentum)
    {
      for (unsigned int d = 0; d < dim; ++d)
        sum.linear[d] += momentum[d];
      add_moment<dim>(sum.angular, arm, momentum);
    }

    /// Throws a UserError on all ranks where gravity is not finite. Collective.
    template <int dim>
    void
    sum_cells(const State<dim>        &state,
              const LiquidDomain<dim> &domain,
              const Point<dim>        &origin,
              Sums<dim>               &sums)
    {
      const Mesh<dim> &mesh = domain.mesh;
      std::string      error;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        if (const double volume = domain.liquid_volume[c]; volume > 0)
          {
            const Point<dim>    &x    = domain.liquid_centre[c];
            const double         mass = domain.density[c] * volume;
            sums.volume += volume;
            sums.mass += mass;
            for (unsigned int d = 0; d < dim; ++d)
              sums.first_moment[d] += mass * (x[d] - origin[d]);
            keep_error(error, [&] {
              const Tensor<1, dim> g = domain.scene.gravity(x, state.time);
              sums.potential_energy -= mass * (g * (x - domain.scene.lower_corner()));
            });
            sums.dissipation += dissipation(domain, c, state.v);
          }
      throw_first(mesh.communicator(), error);
    }

    /// What moves along the normal of a liquid face (kg): of the cell on either side `rho A d`, d from its dual centre to the
    /// face, times the part that is liquid. `sum A d n n^T = V I` over the faces of a cell, which has the energy of the liquid
    /// that it holds. `face_mass`, for which momentum is kept, has that in the mean alone, in films too much.
    template <int dim>
    double
    mass_beside(const LiquidDomain<dim> &domain, const LocalIndex face)
    {
      const Mesh<dim>  &mesh   = domain.mesh;
      const Point<dim>  centre = mesh.face_centre(face);
      const auto [i, j]        = mesh.face_cells[face];
      const auto part          = [&](const LocalIndex c, const double sign) {
        const double open = domain.open_volume(c);
        return domain.is_active_cell[c] && open > 0 ?
                 domain.density[c] * domain.liquid_volume[c] / open * sign * ((centre - mesh.cell_dual[c]) * mesh.face_normal[face]) :
                 0.;
      };
      return domain.open_fraction[face] * mesh.face_area[face] * (part(i, 1) + part(j, -1));
    }

    template <int dim>
    void
    sum_motion(const State<dim>        &state,
               const LiquidDomain<dim> &domain,
               const Point<dim>        &origin,
               Sums<dim>               &sums)
    {
      const Mesh<dim> &mesh = domain.mesh;
      for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
        if (domain.is_liquid_face(f))
          {
            const double u = state.u.local_element(f);
            sums.of_faces.kinetic_energy += 0.5 * mass_beside(domain, f) * u * u;
            add_momentum<dim>(sums.of_faces,
                              mesh.face_centre(f) - origin,
                              domain.face_mass[f] * u * mesh.face_normal[f]);
          }
      for (LocalIndex n = 0; n < mesh.n_owned_nodes(); ++n)
        if (const double mass = domain.node_mass[n]; mass > 0)
          {
            const Tensor<1, dim> v = state.v.value(n);
            sums.of_nodes.kinetic_energy += 0.5 * mass * v.norm_square();
            add_momentum<dim>(sums.of_nodes, mesh.node_position[n] - origin, mass * v);
          }
    }

    /// Narrow the part [t0,t1] of an edge to where a function with these end
    /// values is negative.
    void
    clip(const double a, const double b, double &t0, double &t1)
    {
      if (a >= 0 && b >= 0)
        t1 = -1;
      else if (a >= 0)
        t0 = std::max(t0, a / (a - b));
      else if (b >= 0)
        t1 = std::min(t1, a / (a - b));
    }

    /// The ends of the liquid parts of all edges, and the speed at liquid nodes.
    template <int dim>
    Maxima<dim>
    maxima(const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      const Mesh<dim> &mesh = domain.mesh;
      Maxima<dim>      result;
      result.fill(-std::numeric_limits<double>::infinity());
      const auto include = [&](const Point<dim> &x) {
        for (unsigned int d = 0; d < dim; ++d)
          {
            result[2 * d]     = std::max(result[2 * d], -x[d]);
            result[2 * d + 1] = std::max(result[2 * d + 1], x[d]);
          }
      };
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        if (domain.liquid_volume[c] > 0)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i + 1; j <= dim; ++j)
              {
                const LocalIndex a = mesh.cell_nodes[c][i], b = mesh.cell_nodes[c][j];
                double           t0 = 0, t1 = 1;
                clip(state.phi.local_element(a), state.phi.local_element(b), t0, t1);
                clip(-domain.solid_distance[a], -domain.solid_distance[b], t0, t1);
                if (t0 > t1)
                  continue;
                const Tensor<1, dim> edge = mesh.node_position[b] - mesh.node_position[a];
                include(mesh.node_position[a] + t0 * edge);
                include(mesh.node_position[a] + t1 * edge);
              }
      for (LocalIndex n = 0; n < mesh.n_owned_nodes(); ++n)
        if (domain.is_active_node[n] && state.phi.local_element(n) < 0)
          result.back() = larger(result.back(), state.v.value(n).norm());
      return result;
    }

    /// Angular momentum about the centre of mass, @p arm from where it was taken.
    template <int dim>
    Motion<dim>
    shifted(Motion<dim> motion, const Tensor<1, dim> &arm)
    {
      Tensor<1, dim> momentum;
      for (unsigned int d = 0; d < dim; ++d)
        momentum[d] = motion.linear[d];
      add_moment<dim>(motion.angular, -arm, momentum);
      return motion;
    }
  } // namespace

  template <int dim>
  Measures<dim>
  measure(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    const MPI_Comm  &comm = domain.mesh.communicator();
    const Point<dim> origin =
      domain.scene.lower_corner() +
      (domain.scene.upper_corner() - domain.scene.lower_corner()) / 2;
    Sums<dim> sums;
    sum_cells(state, domain, origin, sums);
    sum_motion(state, domain, origin, sums);
    MPI_Allreduce(
      MPI_IN_PLACE, &sums, sizeof sums / sizeof(double), MPI_DOUBLE, MPI_SUM, comm);
    const Maxima<dim> most = largest(comm, maxima(state, domain));

    Measures<dim> result;
    result.volume           = sums.volume;
    result.potential_energy = sums.potential_energy;
    result.dissipation      = sums.dissipation;
    result.maximum_speed    = larger(0., most.back());
    const bool     is_empty = sums.mass == 0;
    const double   nothing  = std::numeric_limits<double>::quiet_NaN();
    Tensor<1, dim> arm;
    for (unsigned int d = 0; d < dim; ++d)
      {
        arm[d]                   = is_empty ? 0 : sums.first_moment[d] / sums.mass;
        result.centre_of_mass[d] = is_empty ? nothing : origin[d] + arm[d];
        result.lower[d]          = is_empty ? nothing : -most[2 * d];
        result.upper[d]          = is_empty ? nothing : most[2 * d + 1];
      }
    result.of_faces = shifted(sums.of_faces, arm);
    result.of_nodes = shifted(sums.of_nodes, arm);
    return result;
  }

  template Measures<2>
  measure(const State<2> &, const LiquidDomain<2> &);
  template Measures<3>
  measure(const State<3> &, const LiquidDomain<3> &);
} // namespace treacle
