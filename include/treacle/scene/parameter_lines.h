// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_parameter_lines_h
#define treacle_scene_parameter_lines_h

#include <string>
#include <vector>

namespace treacle
{
  /// A line of a parameter file that is not empty, continuation lines joined.
  struct ParameterLine
  {
    enum Kind
    {
      subsection,
      end,
      set,
      other
    };

    unsigned int             first, last; ///< line numbers
    Kind                     kind;
    std::vector<std::string> path; ///< subsections around it
    std::string              name, value;
  };

  /// Split by words and '=' only, as deal.II's own reader does.
  std::vector<ParameterLine>
  parameter_lines(const std::string &text);
} // namespace treacle

#endif
