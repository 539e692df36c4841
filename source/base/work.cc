// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/work.h>

#include <cstdlib>
#include <new>

namespace treacle
{
  std::string
  Work::summary(const MPI_Comm &comm)
  {
    const Work  work = here();
    std::string table;
    const auto  add = [&](const char *name, const double n) {
      char text[128];
      std::snprintf(text, sizeof text, "%-32s %21.0f\n", name, n);
      table += text;
    };
    const auto sum = [&](const std::uint64_t n) {
      return Utilities::MPI::sum(static_cast<double>(n), comm);
    };
    add("Work", Utilities::MPI::n_mpi_processes(comm));
    add("cells made", sum(work.cells_made));
    add("points located", sum(work.points_located));
    add("facets tried", sum(work.facets_tried));
    add("products with matrices", work.products);
    add("preconditionings", work.preconditionings);
    add("preconditioners made", work.preconditioners_made);
    add("MiB allocated", sum(work.bytes_allocated) / (1 << 20));
    return table;
  }
} // namespace treacle

void *
operator new(const std::size_t size)
{
  treacle::Work::here().bytes_allocated += size;
  if (void *const memory = std::malloc(size == 0 ? 1 : size))
    return memory;
  throw std::bad_alloc();
}

void
operator delete(void *const memory) noexcept
{
  std::free(memory);
}

void
operator delete(void *const memory, std::size_t) noexcept
{
  std::free(memory);
}
