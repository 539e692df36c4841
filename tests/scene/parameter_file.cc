// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// How a parameter file is read before its parameters are declared, and what is
// said of one that is wrong.

#include <treacle/base/exceptions.h>
#include <treacle/scene/parameter_file.h>

#include "../tests.h"

namespace tests::scene_parameter_file
{
using namespace treacle;

void
declare(ParameterHandler &prm)
{
  static double       time  = 1;
  static unsigned int level = 5;
  static Point<2>     corner;
  static std::string  format = "ply";
  prm.add_parameter("End time", time, "", Patterns::Double(0));
  prm.declare_entry("Dimension", "3", Patterns::Integer(2, 3));
  prm.enter_subsection("Mesh");
  prm.add_parameter("Surface level", level, "", Patterns::Integer(1, 18));
  prm.add_parameter("Corner", corner, "");
  prm.leave_subsection();
  prm.enter_subsection("Output");
  prm.add_parameter("Surface format", format, "", Patterns::Selection("ply|obj"));
  prm.leave_subsection();
}

void
check(const std::string &text, const std::vector<std::string> &settings = {})
{
  std::ofstream("case.prm") << text;
  try
    {
      const ParameterFile file(MPI_COMM_WORLD, "case.prm", settings);
      tests::out() << "dimension " << file.dimension() << ", liquids "
                   << file.count("Liquid") << ", solids " << file.count("Solid");
      ParameterHandler prm;
      declare(prm);
      for (const char *name : {"Liquid", "Solid"})
        for (unsigned int k = 1; k <= file.count(name); ++k)
          {
            prm.enter_subsection(name + (" " + std::to_string(k)));
            prm.declare_entry("Radius", "1", Patterns::Double());
            prm.leave_subsection();
          }
      file.parse(prm);
      tests::out() << ", end time " << prm.get("End time") << ", level "
                   << prm.get({"Mesh"}, "Surface level") << std::endl;
    }
  catch (const UserError &error)
    {
      tests::out() << '\n' << error.what() << std::endl;
    }
}

void
start(const int, char **)
{

  check(
    "set Dimension = 2 # flat\nsubsection Liquid 1\nend\nsubsection Liquid 2\nend\nsubsection Solid 1\nend",
    {"End time=3", "Mesh/Surface level = 7", "Liquid 2/Radius=2"});
  check("");
  check("set End time = \\\n  2\nsubsection Mesh\n  set Surface level = 6\nend\n",
        {"Liquid 1/Radius=3"});

  check("set Dimension = 4\n");
  check("set End time = 1\n\nset Dimension = 2", {"Dimension=1"});
  check("subsection Liquid 1\nend\nsubsection Liquid 3\nend\n");
  check("subsection Solid 0\nend\n");
  check("subsection Mesh\n  set Surface level = 6\n");
  check("subsection Mesh\nend\nend\n");
  check("# comment\nset Ende time = 2\n");
  check("subsection Mash\nend\n");
  check("subsection Mesh\n  set Level = 3\nend\n");
  check("subsection Mesh\n  set Surface level = 3.5\nend\n");
  check("set End time = \\\n -2\n");
  check("subsection Mesh\n\tset Corner = 0, 0, 0\nend\n");
  check("subsection Output\n  set Surface format = png\nend\n");
  check("set End time\n");
  check("End time = 3\n");
  check("include nothing.prm\n");
  check("", {"Mesh/Surface level=99", "End time=2"});
  check("", {"End time=2", "Mesh/Level=9"});
  check("", {"Mash/Level=9"});
  check("", {"End time"});
  check("", {"=3"});
  try
    {
      ParameterFile(MPI_COMM_WORLD, "missing.prm", {});
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

const Test test("scene/parameter_file", start);
} // namespace tests::scene_parameter_file
