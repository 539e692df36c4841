// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/files.h>
#include <treacle/io/old_table.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace treacle
{
  namespace
  {
    /// The numbers of a line of @p n columns that has come to its end.
    bool
    read_row(const std::string &line, const unsigned int n, std::vector<double> &row)
    {
      std::istringstream words(line);
      row.clear();
      for (std::string word; words >> word;)
        row.push_back(std::strtod(word.c_str(), nullptr)); // knows nan
      return row.size() == n;
    }
  } // namespace

  OldTable::OldTable(const std::string &path, const unsigned int step)
    : path(path)
    , step(step)
  {
    std::ifstream file(path);
    Row           values;
    for (std::string line; std::getline(file, line) && !file.eof();)
      if (line[0] == '#')
        {
          header += line + '\n';
          names.push_back(line.substr(line.find(": ") + 2));
        }
      else if (read_row(line, names.size(), values) && values[0] <= step)
        {
          first = rows.empty() ? values : first;
          last  = values;
          rows += line + '\n';
        }
  }

  std::string
  OldTable::why_not_resumed(const std::vector<std::string> &names_now) const
  {
    if (rows.empty())
      return "The run cannot be resumed: the table \"" + path +
             "\" has no row before step " + std::to_string(step) + ".";
    const auto [old, now] =
      std::mismatch(names.begin(), names.end(), names_now.begin(), names_now.end());
    if (old != names.end() || now != names_now.end())
      return "The run cannot be resumed: only one of the columns of \"" + path +
             "\" and those of this run has \"" + (old != names.end() ? *old : *now) +
             "\"; let the subsections Solid and Probe be as they were.";
    return "";
  }

  double
  OldTable::first_value(const std::string &name) const
  {
    return value(first, name);
  }

  double
  OldTable::last_value(const std::string &name) const
  {
    return value(last, name);
  }

  double
  OldTable::value(const Row &row, const std::string &name) const
  {
    const auto it = std::find(names.begin(), names.end(), name);
    return it == names.end() || row.empty() ? 0. : row[it - names.begin()];
  }

  std::string
  OldTable::rewrite() const
  {
    return replace_file(path, [&](std::ostream &out) { out << header << rows; });
  }
} // namespace treacle
