// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/expression.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>

namespace treacle
{
  namespace
  {
    bool
    is_number(const std::string &text, double &value)
    {
      char *end = nullptr;
      value     = std::strtod(text.c_str(), &end);
      return !text.empty() && *end == '\0' && std::isfinite(value);
    }

    /// muParser takes "0,5" for a list and evaluates its last entry, and "x=1"
    /// for an assignment.
    bool
    is_list_or_assignment(const std::string &text)
    {
      int depth = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          depth += (text[i] == '(') - (text[i] == ')');
          if (text[i] == ',' && depth == 0)
            return true;
          if (text[i] == '=' && i > 0 && text[i + 1] == '=')
            ++i;
          else if (text[i] == '=' &&
                   (i == 0 || std::string("<>!").find(text[i - 1]) == std::string::npos))
            return true;
        }
      return false;
    }

    /// As a name of its own, not in "sqrt".
    bool
    has_name(const std::string &text, const char name)
    {
      const auto is_part = [&](const std::size_t i) { return i < text.size() && (std::isalnum(text[i]) || text[i] == '_'); };
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == name && !is_part(i + 1) && (i == 0 || !is_part(i - 1)))
          return true;
      return false;
    }

    /// deal.II writes a report of its own to std::cerr before it throws.
    class QuietErrors
    {
    public:
      QuietErrors()
        : terminal(std::cerr.rdbuf(report.rdbuf()))
      {}
      ~QuietErrors()
      {
        std::cerr.rdbuf(terminal);
      }

    private:
      std::ostringstream report;
      std::streambuf    *terminal;
    };

    /// The parser's own sentence, as in `Unexpected token "y" found at position 3`.
    std::string
    reason(const ExceptionBase &error)
    {
      std::ostringstream text;
      error.print_info(text);
      const std::string marker = "The parser said: ";
      const std::size_t begin  = text.str().find(marker);
      if (begin == std::string::npos)
        return Utilities::trim(text.str());

      std::string said = Utilities::trim(text.str().substr(begin + marker.size()));
      while (!said.empty() && said.back() == '.')
        said.pop_back();
      return said;
    }
  } // namespace



  template <int dim>
  Expression<dim>::Expression(const std::string &formula,
                              const std::string &where,
                              const bool         in_time)
  {
    const std::string text = Utilities::trim(formula);
    if (is_number(text, constant))
      return;

    names_time            = in_time && has_name(text, 't');
    std::string variables = (dim == 2 ? "x,y" : "x,y,z");
    if (in_time)
      variables += ",t";
    const std::string help =
      "; write a formula in " + variables + ", for example 2*sin(pi*x).";
    require(!text.empty(), where + " is empty" + help);

    require(!is_list_or_assignment(text),
            where + ": \"" + text + "\" is a list or an assignment" + help);

    const QuietErrors quiet;
    parser = std::make_shared<FunctionParser<dim>>();
    try
      {
        parser->initialize(variables, text, {{"pi", numbers::PI}}, in_time);
        parse(Point<dim>(), 0.);
      }
    catch (const ExceptionBase &error)
      {
        throw UserError(where + ": cannot understand \"" + text + "\" (" + reason(error) +
                        ")" + help);
      }
  }



  template <int dim>
  double
  Expression<dim>::parse(const Point<dim> &x, const double t) const
  {
    parser->set_time(t);
    return parser->value(x);
  }



  template <int dim>
  VectorExpression<dim>::VectorExpression(const std::string &formulas,
                                          const std::string &where)
  {
    const std::vector<std::string> parts = Utilities::split_string_list(formulas, ';');
    require(parts.size() == dim,
            where + " has " + std::to_string(parts.size()) + " component(s), \"" +
              formulas + "\", but needs " + std::to_string(dim) +
              ", separated by semicolons, as in \"" + (dim == 2 ? "0; 0" : "0; 0; 0") +
              "\".");
    for (const std::string &part : parts)
      component.emplace_back(part, where, true);
  }



  template <int dim>
  void
  value_error(const std::string &name,
              const double       value,
              const std::string &allowed,
              const Point<dim>  &x,
              const double       t)
  {
    std::ostringstream message;
    message << name << " is " << value << " at x = (" << x << ") and t = " << t
            << " s, but must be " << allowed << " in the liquid at all times.";
    throw UserError(message.str());
  }



  template void
  value_error(const std::string &, const double, const std::string &, const Point<2> &, const double);
  template void
  value_error(const std::string &, const double, const std::string &, const Point<3> &, const double);
  template class Expression<2>;
  template class Expression<3>;
  template class VectorExpression<2>;
  template class VectorExpression<3>;
} // namespace treacle
