// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/io/checkpoint_info.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace treacle
{
  CheckpointInfo::CheckpointInfo(const std::string &text, const std::string &path)
    : path(path)
  {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (const auto equals = line.find(" = "); equals != std::string::npos)
        values[line.substr(0, equals)] = line.substr(equals + 3);
  }

  std::string
  CheckpointInfo::get(const std::string &name) const
  {
    const auto it = values.find(name);
    require(it != values.end(),
            "The file \"" + path + "\" does not say \"" + name + "\".");
    return it->second;
  }

  double
  CheckpointInfo::number(const std::string &name) const
  {
    const std::string text = get(name);
    char             *end  = nullptr;
    const double      x    = std::strtod(text.c_str(), &end);
    require(!text.empty() && *end == '\0',
            "The file \"" + path + "\" is damaged: \"" + name + "\" is \"" + text + "\".");
    return x;
  }

  std::uint64_t
  CheckpointInfo::count(const std::string &name) const
  {
    const double x = number(name); // exact below 2^53
    require(x >= 0 && x == std::floor(x),
            "The file \"" + path + "\" is damaged: \"" + name + "\" is " + get(name) + ".");
    return static_cast<std::uint64_t>(x);
  }

  std::map<std::string, double>
  CheckpointInfo::scalars(const std::string &prefix) const
  {
    std::map<std::string, double> result;
    for (const auto &[name, value] : values)
      if (name.compare(0, prefix.size(), prefix) == 0)
        result[name.substr(prefix.size())] = std::strtod(value.c_str(), nullptr);
    return result;
  }

  void
  CheckpointInfo::require_same(const std::string &name,
                               const std::string &parameter,
                               const std::string &value) const
  {
    require(get(name) == value,
            "The run cannot be resumed: the checkpoint has " + parameter + " = " +
              get(name) + ", the parameter file has " + value +
              ". Restore it, or start a new run.");
  }
} // namespace treacle
