// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// treacle_tests NAME [ARGUMENT]...: runs one of the tests, in the working directory.

#include "tests.h"

#include <iostream>

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto                              &all  = tests::Test::all();
  const auto                               test = all.find(argc > 1 ? argv[1] : "");
  if (test == all.end())
    {
      std::cerr << "usage: treacle_tests NAME [ARGUMENT]...; the names are:\n";
      for (const auto &[name, function] : all)
        std::cerr << "  " << name << '\n';
      return 1;
    }
  test->second(argc - 1, argv + 1);
}
