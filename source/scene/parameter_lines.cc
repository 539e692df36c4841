// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/scene/parameter_lines.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace treacle
{
  using namespace dealii;

  namespace
  {
    using Line = ParameterLine;

    Line
    classify(const std::string &text)
    {
      const auto is = [&](const std::string &word) {
        return text.compare(0, word.size(), word) == 0;
      };
      if (is("subsection ") || is("SUBSECTION "))
        return {0, 0, Line::subsection, {}, Utilities::trim(text.substr(11)), ""};
      if (text == "end" || text == "END")
        return {0, 0, Line::end, {}, "", ""};
      const auto equals = text.find('=');
      if ((is("set ") || is("SET ")) && equals != std::string::npos)
        return {0,
                0,
                Line::set,
                {},
                Utilities::trim(text.substr(4, equals - 4)),
                Utilities::trim(text.substr(equals + 1))};
      return {0, 0, Line::other, {}, text, ""};
    }

    /// Without comment, and white space at the ends.
    std::string
    content(const std::string &line)
    {
      std::string text = line.substr(0, line.find('#'));
      std::replace(text.begin(), text.end(), '\t', ' ');
      std::replace(text.begin(), text.end(), '\r', ' ');
      return Utilities::trim(text);
    }

    /// Say in which subsections the line stands; @p path is that of the next one then.
    void
    place(Line &line, std::vector<std::string> &path, const std::string &text)
    {
      if (line.kind == Line::end && !path.empty())
        path.pop_back();
      else if (line.kind == Line::end)
        {
          line.kind = Line::other; // nothing to end
          line.name = text;
        }
      line.path = path;
      if (line.kind == Line::subsection)
        path.push_back(line.name);
    }
  } // namespace

  std::vector<ParameterLine>
  parameter_lines(const std::string &text)
  {
    std::vector<Line>        lines;
    std::vector<std::string> path;
    std::istringstream       stream(text);
    unsigned int             number = 0, first = 0;
    std::string              whole;
    for (std::string part; std::getline(stream, part);)
      {
        ++number;
        first = whole.empty() ? number : first;
        part  = content(part);
        if (!part.empty() && part.back() == '\\')
          {
            whole += part.substr(0, part.size() - 1);
            continue;
          }
        whole = Utilities::trim(whole + part);
        if (whole.empty())
          continue;
        Line line  = classify(whole);
        line.first = first;
        line.last  = number;
        place(line, path, whole);
        lines.push_back(line);
        whole.clear();
      }
    return lines;
  }
} // namespace treacle
