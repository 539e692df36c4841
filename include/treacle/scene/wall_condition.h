// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_wall_condition_h
#define treacle_scene_wall_condition_h

#include <array>
#include <string>

namespace treacle
{
  enum class WallCondition
  {
    no_slip,
    free_slip
  };

  /// Of the sides of the box, in the order 2 axis + upper, then the default, which holds
  /// for all other walls.
  template <int dim>
  using WallConditions = std::array<WallCondition, 2 * dim + 1>;

  /// From a text like "default: no slip; left, right: free slip". Sides that are not
  /// mentioned, by name or as "default", are no slip. Throws a UserError that says what
  /// is wrong.
  template <int dim>
  WallConditions<dim>
  parse_wall_condition(const std::string &text);
} // namespace treacle

#endif
