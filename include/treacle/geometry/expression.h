// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_expression_h
#define treacle_geometry_expression_h

#include <treacle/base/types.h>

#include <deal.II/base/function_parser.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace treacle
{
  /// A formula in x,y,z (2D: x,y) and, if @p in_time, t, with pi and what
  /// muParser and deal.II's FunctionParser know. A plain number is evaluated
  /// without the parser. Copies share the parser: one thread per process.
  template <int dim>
  class Expression
  {
  public:
    /// @p where names the parameter, as in "Liquid 1/Velocity". Throws a
    /// UserError that quotes the formula if it cannot be understood.
    Expression(const std::string &formula, const std::string &where, const bool in_time);

    double
    operator()(const Point<dim> &x, const double t = 0) const
    {
      return parser ? parse(x, t) : constant;
    }

    bool
    is_constant() const
    {
      return !parser;
    }

    /// Is t in it?
    bool
    depends_on_time() const
    {
      return names_time;
    }

  private:
    double
    parse(const Point<dim> &x, const double t) const;

    double                               constant   = 0;
    bool                                 names_time = false;
    std::shared_ptr<FunctionParser<dim>> parser; // null for a plain number
  };



  /// Throw a UserError: parameter @p name is @p value at x and t, but must be @p allowed.
  template <int dim>
  [[noreturn]] void
  value_error(const std::string &name,
              const double       value,
              const std::string &allowed,
              const Point<dim>  &x,
              const double       t);



  /// One formula in x,y,z,t per component, separated by semicolons.
  template <int dim>
  class VectorExpression
  {
  public:
    VectorExpression(const std::string &formulas, const std::string &where);

    Tensor<1, dim>
    operator()(const Point<dim> &x, const double t) const
    {
      Tensor<1, dim> value;
      for (unsigned int d = 0; d < dim; ++d)
        value[d] = component[d](x, t);
      return value;
    }

    bool
    depends_on_time() const
    {
      return std::any_of(component.begin(), component.end(), [](const auto &c) { return c.depends_on_time(); });
    }

  private:
    std::vector<Expression<dim>> component;
  };
} // namespace treacle

#endif
