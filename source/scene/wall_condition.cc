// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exceptions.h>
#include <treacle/scene/wall_condition.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>
#include <vector>

namespace treacle
{
  using namespace dealii;

  namespace
  {
    /// In the order of parse_wall_condition().
    template <int dim>
    std::vector<std::string>
    side_names()
    {
      if (dim == 2)
        return {"left", "right", "bottom", "top"};
      return {"left", "right", "front", "back", "bottom", "top"};
    }

    [[noreturn]] void
    wall_condition_error(const std::string &text,
                         const std::string &problem,
                         const int          dim)
    {
      throw UserError("Domain/Wall condition is \"" + text + "\", but " + problem +
                      "; write \"no slip\" or \"free slip\", or conditions per side as "
                      "in \"default: no slip; left, right: free slip\", with the sides "
                      "left, right, " +
                      (dim == 3 ? "front, back, " : "") + "bottom, top.");
    }
  } // namespace

  template <int dim>
  WallConditions<dim>
  parse_wall_condition(const std::string &text)
  {
    const Choice<WallCondition>          conditions{{"no slip", WallCondition::no_slip},
                                           {"free slip", WallCondition::free_slip}};
    const std::vector<std::string>       sides = side_names<dim>();
    std::map<std::string, WallCondition> given;
    for (const std::string &clause : Utilities::split_string_list(text, ';'))
      {
        const std::size_t colon = clause.find(':');
        const std::string condition =
          Utilities::trim(colon == std::string::npos ? clause : clause.substr(colon + 1));
        const std::string names =
          colon == std::string::npos ? "default" : clause.substr(0, colon);

        if (!conditions.has(condition))
          wall_condition_error(text, "\"" + condition + "\" is no condition", dim);
        for (const std::string &name : Utilities::split_string_list(names, ','))
          {
            if (name != "default" && std::count(sides.begin(), sides.end(), name) == 0)
              wall_condition_error(text, "\"" + name + "\" is no side", dim);
            if (!given.emplace(name, conditions.value(condition)).second)
              wall_condition_error(text, "it sets \"" + name + "\" twice", dim);
          }
      }
    if (given.empty())
      wall_condition_error(text, "it sets no side", dim);

    given.emplace("default", WallCondition::no_slip);
    WallConditions<dim> result;
    result[2 * dim] = given["default"];
    for (unsigned int side = 0; side < 2 * dim; ++side)
      result[side] = given[given.count(sides[side]) ? sides[side] : "default"];
    return result;
  }

  template WallConditions<2>
  parse_wall_condition<2>(const std::string &);
  template WallConditions<3>
  parse_wall_condition<3>(const std::string &);
} // namespace treacle
