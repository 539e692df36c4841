// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_material_h
#define treacle_scene_material_h

#include <treacle/geometry/expression.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// What density and viscosity do when the liquid moves.
  enum class MaterialTransport
  {
    fixed,
    advected
  };

  /// Density and viscosity of a liquid.
  template <int dim>
  class Material
  {
  public:
    struct Parameters
    {
      std::string density;   // kg/m^dim
      std::string viscosity; // Pa s

      bool
      is_empty() const
      {
        return density.empty() && viscosity.empty();
      }

      /// Declare in the current subsection; @p remark ends the documentation.
      void
      add_parameters(ParameterHandler &prm, const std::string &remark);
    };

    /// @p where names the subsection in messages. What is empty is as in
    /// @p otherwise. Throws a UserError where a formula makes no sense.
    Material(const Parameters  &parameters,
             const std::string &where,
             const Material    *otherwise = nullptr);

    /// kg/m^dim. Throws a UserError if it is not positive.
    double
    density(const Point<dim> &x, const double t) const;

    /// Pa s. Throws a UserError if it is negative.
    double
    viscosity(const Point<dim> &x, const double t) const;

    bool
    viscosity_is_constant() const
    {
      return viscosity_at.is_constant();
    }

  private:
    std::string     density_name, viscosity_name;
    Expression<dim> density_at, viscosity_at;
  };
} // namespace treacle

#endif
