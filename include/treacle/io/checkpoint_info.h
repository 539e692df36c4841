// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_checkpoint_info_h
#define treacle_io_checkpoint_info_h

#include <cstdint>
#include <map>
#include <string>

namespace treacle
{
  /// What the text file of a checkpoint says, in lines "name = value".
  class CheckpointInfo
  {
  public:
    /// @p path names the file in messages.
    CheckpointInfo(const std::string &text, const std::string &path);

    /// Throws a UserError if there is no such line.
    std::string
    get(const std::string &name) const;

    /// Throw a UserError if there is none.
    double
    number(const std::string &name) const;
    std::uint64_t
    count(const std::string &name) const;

    /// All numbers under names that begin with @p prefix, without it.
    std::map<std::string, double>
    scalars(const std::string &prefix) const;

    /// Throws a UserError unless the line says what the parameter does.
    void
    require_same(const std::string &name,
                 const std::string &parameter,
                 const std::string &value) const;

  private:
    std::string                        path;
    std::map<std::string, std::string> values;
  };
} // namespace treacle

#endif
