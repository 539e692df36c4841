// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_table_row_h
#define treacle_io_table_row_h

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace treacle
{
  /// One line of a table of numbers, under the names of its columns.
  class TableRow
  {
  public:
    void
    count(const std::string &name, const std::uint64_t value);

    void
    number(const std::string &name, const double value);

    /// One column a component, with its axis; one without if there is only one.
    template <typename Components>
    void
    vector(const std::string &name,
           const std::string &unit,
           const Components  &values,
           const unsigned int n)
    {
      for (unsigned int d = 0; d < n; ++d)
        number(name + (n == 1 ? "" : std::string(" ") + "xyz"[d]) + " (" + unit + ")",
               values[d]);
    }

    /// By the name of its column, which there is.
    double
    value(const std::string &name) const;

    std::vector<std::string>
    names() const;

    /// The lines before the first row.
    void
    write_header(std::ostream &out) const;

    void
    write(std::ostream &out) const;

    /// A number as a row shows it, and who reads it knows it.
    static double
    rounded(const double value);

  private:
    struct Entry
    {
      std::string name;
      double      value;
      bool        is_count;
    };

    std::vector<Entry> entries;
  };
} // namespace treacle

#endif
