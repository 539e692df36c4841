// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/io/table_row.h>

#include <deal.II/base/exceptions.h>

#include <cstdio>
#include <cstdlib>

namespace treacle
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int width = 20;
  } // namespace

  void
  TableRow::count(const std::string &name, const std::uint64_t value)
  {
    entries.push_back({name, static_cast<double>(value), true});
  }

  void
  TableRow::number(const std::string &name, const double value)
  {
    entries.push_back({name, value, false});
  }

  double
  TableRow::value(const std::string &name) const
  {
    for (const Entry &entry : entries)
      if (entry.name == name)
        return entry.value;
    AssertThrow(false, ExcMessage("There is no statistic \"" + name + "\"."));
    return 0;
  }

  std::vector<std::string>
  TableRow::names() const
  {
    std::vector<std::string> result;
    for (const Entry &entry : entries)
      result.push_back(entry.name);
    return result;
  }

  void
  TableRow::write_header(std::ostream &out) const
  {
    for (unsigned int k = 0; k < entries.size(); ++k)
      out << "# " << k + 1 << ": " << entries[k].name << '\n';
  }

  void
  TableRow::write(std::ostream &out) const
  {
    char text[64];
    for (const Entry &entry : entries)
      {
        if (entry.is_count)
          std::snprintf(text, sizeof text, "%*.0f", width - 8, entry.value);
        else
          std::snprintf(text, sizeof text, "%*.11e", width, entry.value);
        out << text;
      }
    out << std::endl;
  }

  double
  TableRow::rounded(const double value)
  {
    char text[64];
    std::snprintf(text, sizeof text, "%.11e", value);
    return std::strtod(text, nullptr);
  }
} // namespace treacle
