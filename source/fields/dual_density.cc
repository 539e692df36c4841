// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/dual_density.h>
#include <treacle/fields/gradients.h>

namespace treacle
{
  namespace
  {
    /// The mean of a positive function along a part, at whose ends it has these values; jumps are found by halving.
    template <int dim, typename Function>
    double
    mean(const DualPart<dim> &part, const Function &f, const double at_begin, const double at_end, const unsigned int n_halvings = 30)
    {
      constexpr double smooth    = 1.1; // largest over smallest value
      const double     at_middle = f(part.at(0.5));
      const auto [least, most]   = std::minmax({at_begin, at_middle, at_end});
      if (n_halvings == 0 || most <= smooth * least)
        return part.mean(f);
      const Tensor<1, dim> half = 0.5 * part.way;
      return 0.5 * (mean<dim>({part.begin, half}, f, at_begin, at_middle, n_halvings - 1) +
                    mean<dim>({part.at(0.5), half}, f, at_middle, at_end, n_halvings - 1));
    }

    /// Of what is carried, which is P1 in the cells on both sides.
    template <int dim>
    double
    carried_mean(const Mesh<dim> &mesh, const Vector &at_nodes, const LocalIndex face, const DualPart<dim> &part)
    {
      const Tensor<1, dim> &normal  = mesh.face_normal[face];
      const double          to_face = (mesh.face_centre(face) - part.begin) * normal / (part.way * normal);
      const double          here    = std::min(std::max(to_face, 0.), 1.);
      double                least = std::numeric_limits<double>::max(), most = 0, sum = 0;
      const auto            add = [&](const LocalIndex cell, const double share, const double middle) {
        const VertexValues<dim> values = mesh.values(cell, at_nodes);
        const auto [lower, upper]      = std::minmax_element(values.begin(), values.end());
        least                          = std::min(least, *lower);
        most                           = std::max(most, *upper);
        sum += share * interpolate(values, weights_at(mesh, cell, part.at(middle)));
      };
      auto [begin, end] = mesh.face_cells[face];
      if (part.way * normal < 0)
        std::swap(begin, end);
      add(begin, here, here / 2);
      add(end, 1 - here, (1 + here) / 2);
      return std::min(std::max(sum, least), most); // dual centres may lie outside of their cells
    }
  } // namespace

  template <int dim>
  double
  mean_density(const Scene<dim> &scene, const State<dim> &state, const LocalIndex face, const DualPart<dim> &part)
  {
    if (state.material)
      return carried_mean(*state.mesh, state.material->density.mean, face, part);
    const auto density = [&](const Point<dim> &x) { return scene.density(x, state.time); };
    return mean(part, density, density(part.begin), density(part.at(1)));
  }

  template double
  mean_density(const Scene<2> &, const State<2> &, const LocalIndex, const DualPart<2> &);
  template double
  mean_density(const Scene<3> &, const State<3> &, const LocalIndex, const DualPart<3> &);
} // namespace treacle
