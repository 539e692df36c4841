// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_old_table_h
#define treacle_io_old_table_h

#include <string>
#include <vector>

namespace treacle
{
  /// The table of a run that is resumed: its rows up to a step that have come to their
  /// end. The first column is the step's number.
  class OldTable
  {
  public:
    OldTable(const std::string &path, const unsigned int step);

    /// Why rows with these columns cannot go on with it; empty if they can.
    std::string
    why_not_resumed(const std::vector<std::string> &names_now) const;

    /// Of a column in the first and last row; zero without.
    double
    first_value(const std::string &name) const;
    double
    last_value(const std::string &name) const;

    /// Write it without what was dropped. Return what went wrong, or nothing.
    std::string
    rewrite() const;

  private:
    using Row = std::vector<double>;

    double
    value(const Row &row, const std::string &name) const;

    std::string              path;
    unsigned int             step;
    std::string              header, rows;
    std::vector<std::string> names; ///< of the columns
    Row                      first, last;
  };
} // namespace treacle

#endif
