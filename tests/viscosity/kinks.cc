// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Layers of viscosity 1 and 50 that slide on one another, with an interface askew to the mesh, on leaves of two sizes: velocity has a kink there, which
// cells that the interface cuts take up, and the power that viscosity takes in each is exact. A rigid motion takes none, and the matrix is symmetric. Where one side
// has no viscosity there is none. Where a free surface crosses the layers no motion wins power.

#include "../tests.h"
#include "../body.h"

#include <treacle/fields/gradients.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace tests::viscosity_kinks
{
namespace
{
  template <int dim>
  struct Layers
  {
    Tensor<1, dim> up, along; ///< unit vectors
    double         height = 0.55;

    Layers()
    {
      const std::array<double, 3> n = dim == 2 ? std::array<double, 3>{{0.6, 0.8, 0}} : std::array<double, 3>{{0.48, 0.36, 0.8}};
      for (unsigned int d = 0; d < dim; ++d)
        up[d] = n[d];
      along[0] = -n[1] / std::hypot(n[0], n[1]);
      along[1] = n[0] / std::hypot(n[0], n[1]);
    }

    /// Shear stress 1.
    Tensor<1, dim>
    velocity(const Point<dim> &x) const
    {
      const double above = x * up - height;
      return (above < 0 ? above / 50 : above) * along;
    }

    std::string
    viscosity() const
    {
      std::ostringstream text;
      text << "if(" << up[0] << "*x + " << up[1] << "*y";
      if (dim == 3)
        text << " + " << up[2] << "*z";
      text << " < " << height << ", 50, 1)";
      return text.str();
    }
  };

  /// Of a cell: the stress, times its volume, of the velocity of nodes.
  template <int dim>
  Tensor<2, dim>
  stress(const typename NodeSystem<dim>::Stiffness &stiffness, const LocalIndex c, const Tensor<2, dim> &gradient)
  {
    Tensor<2, dim> sigma = stiffness.strain[c] * (gradient + transpose(gradient));
    if (stiffness.skin.has(c))
      sigma += 2 * stiffness.strain[c] * stiffness.skin.stress(c, gradient);
    if (stiffness.kinks.has(c))
      sigma += stiffness.kinks.stress(c, gradient);
    return sigma;
  }

  /// The largest of what @p value (cell) is in cells with a jump.
  template <int dim, typename Value>
  double
  largest(const Body<dim> &body, const typename NodeSystem<dim>::Stiffness &stiffness, const Value &value)
  {
    double most = 0;
    for (LocalIndex c = 0; c < body.state.mesh->cell_nodes.size(); ++c)
      if (stiffness.kinks.has(c))
        most = std::max(most, std::abs(value(c)));
    return Utilities::MPI::max(most, body.state.mesh->communicator());
  }

  std::string
  verdict(const double x)
  {
    return x < 1e-8 ? "below 1e-8" : x > 0.05 ? "above 0.05" : "in between";
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    const Layers<dim> layers;
    const Body<dim>   body(comm,
                         "subsection Mesh\nset Surface level = 4\nset Interior level = 2\nset Air level = 2\nset Size = if(x < 0.4, 0.125, 1)\nend\n"
                         "subsection Material\nset Viscosity = " + layers.viscosity() +
                           "\nend\nsubsection Liquid 1\nset Shape = expression\nset Expression = -1\nend\n");
    const auto        make = [&](const auto &velocity) {
      NodeVector<dim> v(body.state.mesh->nodes);
      for (LocalIndex node = 0; node < body.state.mesh->n_owned_nodes(); ++node)
        v.set(node, velocity(body.state.mesh->node_position[node]));
      v.update_ghost_values();
      return v;
    };
    const NodeVector<dim> sliding = make([&](const Point<dim> &x) { return layers.velocity(x); });
    const NodeVector<dim> turning = make([&](const Point<dim> &x) { return (x * layers.up) * layers.along - (x * layers.along) * layers.up; });
    const Mesh<dim>      &mesh      = *body.state.mesh;
    const auto            stiffness = Viscosity<dim>(body.prm.dynamics.viscosity).stiffness(body.domain, 1);
    const auto            exact     = [&](const LocalIndex c) { // shear stress 1 times the rates of shear
      const auto &part = body.domain.viscosity_jumps.at(c).part;
      return body.domain.liquid_volume[c] * (part[0] + part[1] / 50);
    };
    const auto energy = [&](const bool with_kinks) {
      return verdict(largest(body, stiffness, [&](const LocalIndex c) {
        const Tensor<2, dim> gradient = velocity_gradient(mesh, c, sliding);
        const Tensor<2, dim> sigma =
          with_kinks ? stress<dim>(stiffness, c, gradient) : stiffness.strain[c] * (gradient + transpose(gradient));
        return scalar_product(sigma, gradient) / exact(c) - 1;
      }));
    };
    out() << dim << "D: power off by " << energy(true) << ", without kinks by " << energy(false) << "; turning "
          << verdict(largest(body,
                             stiffness,
                             [&](const LocalIndex c) {
                               return stress<dim>(stiffness, c, velocity_gradient(mesh, c, turning)).norm() / stiffness.strain[c];
                             }))
          << ", blocks askew by " << verdict(largest(body, stiffness, [&](const LocalIndex c) {
               const auto &g = mesh.cell_gradients[c];
               return (stiffness.kinks.block(c, g[0], g[1]) - transpose(stiffness.kinks.block(c, g[1], g[0]))).norm() /
                      (stiffness.strain[c] * g[0].norm() * g[1].norm());
             }))
          << std::endl;
  }

  /// The least eigenvalue of a cell's power over rates of strain.
  template <int dim>
  double
  least_power(const typename NodeSystem<dim>::Stiffness &stiffness, const LocalIndex c)
  {
    using Strain             = SymmetricTensor<2, dim>;
    constexpr unsigned int n = Strain::n_independent_components;
    LAPACKFullMatrix<double> power(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          Strain e, f;
          e[Strain::unrolled_to_component_indices(i)] = 1;
          f[Strain::unrolled_to_component_indices(j)] = 1;
          power(i, j) = scalar_product(stress<dim>(stiffness, c, e), Tensor<2, dim>(f)) / stiffness.strain[c];
        }
    dealii::Vector<double> eigenvalues;
    FullMatrix<double>     eigenvectors;
    power.compute_eigenvalues_symmetric(-1e30, 1e30, 0, eigenvalues, eigenvectors);
    return *std::min_element(eigenvalues.begin(), eigenvalues.end());
  }

  /// A free surface across the layers, where the liquid is so stiff that cells have a skin.
  template <int dim>
  void
  check_surface(const MPI_Comm &comm)
  {
    const Layers<dim> layers;
    const Body<dim>   body(comm,
                         "subsection Mesh\nset Surface level = 4\nset Interior level = 3\nset Air level = 2\nend\n"
                         "subsection Material\nset Viscosity = 1e4*" + layers.viscosity() +
                           "\nend\nsubsection Liquid 1\nset Shape = half space\nset Centre = 0.4, 0.4" + (dim == 2 ? "" : ", 0.4") +
                           "\nset Normal = 1, 0" + (dim == 2 ? "" : ", 0") + "\nend\n");
    auto stiffness = Viscosity<dim>(body.prm.dynamics.viscosity).stiffness(body.domain, 1);
    stiffness.skin = Skin<dim>(body.domain, body.state.phi, 1);
    double least   = std::numeric_limits<double>::max();
    bool   has_any = false;
    for (const auto &jump : body.domain.viscosity_jumps)
      {
        least   = std::min(least, least_power<dim>(stiffness, jump.first));
        has_any = has_any || stiffness.skin.has(jump.first);
      }
    least   = Utilities::MPI::min(least, comm);
    has_any = Utilities::MPI::logical_or(has_any, comm);
    if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
      std::cout << dim << "D, a free surface: least power " << least << std::endl;
    out() << dim << "D, a free surface across the layers: " << (has_any ? "cells with a skin" : "NO SKIN") << ", power "
          << (least > 0.02 ? "is taken" : "IS WON, OR ALL BUT") << std::endl;
  }

  /// A viscous drop in a pool without viscosity, which have no shear stress in common.
  void
  check_thin(const MPI_Comm &comm)
  {
    const auto row = run_scene<2>(comm,
                                  "set End time = 0.1\nset Frame interval = 0.1\n"
                                  "subsection Mesh\nset Surface level = 4\nset Interior level = 3\nset Air level = 2\nend\n"
                                  "subsection Gravity\nset Acceleration = 0; -9.81\nend\n"
                                  "subsection Material\nset Viscosity = 0\nset Transport = advected\nend\n"
                                  "subsection Liquid 1\nset Shape = half space\nset Centre = 0.5, 0.4\nset Normal = 0, 1\nend\n"
                                  "subsection Liquid 2\nset Centre = 0.5, 0.4\nset Radius = 0.2\nset Viscosity = 100\nend\n",
                                  0,
                                  2)
                       .back();
    const double fastest = row.at("Maximum speed (m/s)");
    out() << "2D, no viscosity on one side: " << row.at("Fallbacks") << " fallbacks, speed " << (fastest > 0 && fastest < 1 ? "below 1" : "WRONG")
          << " m/s" << std::endl;
  }
} // namespace

void
start(int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
    check_surface<2>(comm);
    check_surface<3>(comm);
    check_thin(comm);
  });
}

const Test test("viscosity/kinks", start);
} // namespace tests::viscosity_kinks
