// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_parameter_file_h
#define treacle_scene_parameter_file_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace treacle
{
  using namespace dealii;

  /// The text of a parameter file with the settings of the command line behind
  /// it. Knows what must be known before parameters can be declared.
  class ParameterFile
  {
  public:
    /// Rank 0 reads the file; an empty name stands for an empty file with one
    /// of each numbered subsection. A setting is "Section/Name=value". Throws a UserError
    /// on all ranks. Collective.
    ParameterFile(const MPI_Comm                 &comm,
                  const std::string              &name,
                  const std::vector<std::string> &settings);

    /// 2 or 3.
    unsigned int
    dimension() const
    {
      return dim;
    }

    /// How many numbered subsections of this name there are: Liquid, Solid, Emitter,
    /// Probe.
    unsigned int
    count(const std::string &name) const
    {
      const auto it = n_numbered.find(name);
      return it == n_numbered.end() ? 0 : it->second;
    }

    /// Throws a UserError that says where and what is allowed; the same on all
    /// ranks, for the text is.
    void
    parse(ParameterHandler &prm) const;

  private:
    /// Throws a UserError where a subsection has no end.
    void
    check_closed() const;

    void
    append(const std::string &setting);

    void
    scan();

    /// "the file, line 7" or "--set 'Section/Name=value'".
    std::string
    place(const unsigned int line) const;

    [[noreturn]] void
    explain(const std::string &message, const ParameterHandler &prm) const;

    std::string                         name, text;
    unsigned int                        n_lines = 0, n_file_lines = 0;
    std::map<unsigned int, std::string> setting_at; ///< by its last line
    unsigned int                        dim = 3;
    std::map<std::string, unsigned int> n_numbered;
  };
} // namespace treacle

#endif
