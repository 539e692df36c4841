// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/scene/material.h>

namespace treacle
{
  template <int dim>
  void
  Material<dim>::Parameters::add_parameters(ParameterHandler &prm, const std::string &remark)
  {
    const std::string variables = (dim == 2 ? "x,y,t" : "x,y,z,t");
    prm.add_parameter("Density",
                      density,
                      "Density (kg/m^3; 2D: kg/m^2): a formula in " + variables +
                        ", positive in the liquid" + remark);
    prm.add_parameter("Viscosity",
                      viscosity,
                      "Dynamic viscosity (Pa s): a formula in " + variables +
                        ", not negative in the liquid" + remark);
  }

  template <int dim>
  Material<dim>::Material(const Parameters  &prm,
                          const std::string &where,
                          const Material    *otherwise)
    : density_name(where + "/Density")
    , viscosity_name(where + "/Viscosity")
    , density_at(prm.density.empty() && otherwise ? otherwise->density_at :
                                                    Expression<dim>(prm.density, density_name, true))
    , viscosity_at(prm.viscosity.empty() && otherwise ?
                     otherwise->viscosity_at :
                     Expression<dim>(prm.viscosity, viscosity_name, true))
  {
    if (density_at.is_constant())
      density(Point<dim>(), 0.);
    if (viscosity_at.is_constant())
      viscosity(Point<dim>(), 0.);
  }

  template <int dim>
  double
  Material<dim>::density(const Point<dim> &x, const double t) const
  {
    const double value = density_at(x, t);
    if (!(value > 0 && std::isfinite(value)))
      value_error(density_name, value, "positive", x, t);
    return value;
  }

  template <int dim>
  double
  Material<dim>::viscosity(const Point<dim> &x, const double t) const
  {
    const double value = viscosity_at(x, t);
    if (!(value >= 0 && std::isfinite(value)))
      value_error(viscosity_name, value, "zero or positive", x, t);
    return value;
  }

  template class Material<2>;
  template class Material<3>;
} // namespace treacle
