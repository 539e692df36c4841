// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/carried_in_cell.h>
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

    /// How much of a way along which the mean at the nodes goes from one value to another is of the upper one of the two between which the property
    /// jumps: all goes over while the mean does the middle third of its way.
    double
    part_of_upper(const TwoValues &two, const double from, const double to)
    {
      const double middle = 0.5 * (two.least() + two.largest()), half = (two.largest() - two.least()) / 6;
      const auto   integral = [&](const double mean) {
        const double x = mean - middle;
        return x <= -half ? 0. : x >= half ? x : (x + half) * (x + half) / (4 * half);
      };
      if (std::abs(to - from) > 1e-6 * half)
        return (integral(to) - integral(from)) / (to - from);
      return std::min(std::max((0.5 * (from + to) - middle + half) / (2 * half), 0.), 1.);
    }

    /// Of what is carried, which is P1 in the cells on both sides, and where it jumps goes over within a third of a leaf or so: that is less than the mean
    /// at the nodes needs, and enough for these to know the place to a part of a leaf.
    template <int dim>
    double
    carried_mean(const Mesh<dim> &mesh, const CarriedField &field, const LocalIndex face, const DualPart<dim> &part)
    {
      const Tensor<1, dim> &normal  = mesh.face_normal[face];
      const double          to_face = (mesh.face_centre(face) - part.begin) * normal / (part.way * normal);
      const double          here    = std::min(std::max(to_face, 0.), 1.);
      double                least = std::numeric_limits<double>::max(), most = 0, sum = 0;
      const auto            add = [&](const LocalIndex cell, const double begin, const double end) {
        const VertexValues<dim>  values = mesh.values(cell, field.mean);
        const CarriedInCell<dim> carried(mesh, field, cell);
        const auto               at = [&](const double t) { return interpolate(values, weights_at(mesh, cell, part.at(t))); };
        if (carried.jumps())
          {
            const TwoValues &two = carried.values();
            least                = std::min(least, two.least());
            most                 = std::max(most, two.largest());
            sum += (end - begin) * (two.least() + part_of_upper(two, at(begin), at(end)) * (two.largest() - two.least()));
            return;
          }
        const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
        least                     = std::min(least, *lower);
        most                      = std::max(most, *upper);
        sum += (end - begin) * at((begin + end) / 2);
      };
      auto [begin, end] = mesh.face_cells[face];
      if (part.way * normal < 0)
        std::swap(begin, end);
      add(begin, 0, here);
      add(end, here, 1);
      return std::min(std::max(sum, least), most); // dual centres may lie outside of their cells
    }
  } // namespace

  template <int dim>
  double
  mean_density(const Scene<dim> &scene, const State<dim> &state, const LocalIndex face, const DualPart<dim> &part)
  {
    if (state.material)
      return carried_mean(*state.mesh, state.material->density, face, part);
    const auto density = [&](const Point<dim> &x) { return scene.density(x, state.time); };
    return mean(part, density, density(part.begin), density(part.at(1)));
  }

  template double
  mean_density(const Scene<2> &, const State<2> &, const LocalIndex, const DualPart<2> &);
  template double
  mean_density(const Scene<3> &, const State<3> &, const LocalIndex, const DualPart<3> &);
} // namespace treacle
