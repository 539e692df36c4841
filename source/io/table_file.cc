// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/io/table_file.h>

#include <deal.II/base/mpi_large_count.h>

namespace treacle
{
  namespace
  {
    template <typename T>
    MPI_Datatype
    mpi_type()
    {
      return std::is_same_v<T, double> ? MPI_DOUBLE : MPI_INT;
    }

    /// Say on all ranks what an MPI call told one of them.
    void
    check(const MPI_Comm &comm, const int code, const std::string &path)
    {
      std::string message;
      if (code != MPI_SUCCESS)
        {
          char text[MPI_MAX_ERROR_STRING];
          int  length;
          MPI_Error_string(code, text, &length);
          message = "The file \"" + path + "\" cannot be written or read: " + text + ".";
        }
      throw_first(comm, message);
    }

    /// Collective; @p use does the work and returns MPI's code.
    template <typename Use>
    void
    with_file(const MPI_Comm    &comm,
              const std::string &path,
              const int          mode,
              const Use         &use)
    {
      MPI_File file;
      check(comm, MPI_File_open(comm, path.c_str(), mode, MPI_INFO_NULL, &file), path);
      const int code      = use(file);
      const int when_done = MPI_File_close(&file);
      check(comm, code != MPI_SUCCESS ? code : when_done, path);
    }
  } // namespace

  template <typename T>
  void
  TableFile<T>::write(const MPI_Comm       &comm,
                      const std::string    &path,
                      const std::vector<T> &part)
  {
    const std::uint64_t n      = part.size();
    const std::uint64_t offset = sum_of_lower_ranks(comm, n);
    with_file(comm, path, MPI_MODE_CREATE | MPI_MODE_WRONLY, [&](MPI_File &file) {
      return Utilities::MPI::LargeCount::File_write_at_all_c(
        file, offset * sizeof(T), part.data(), n, mpi_type<T>(), MPI_STATUS_IGNORE);
    });
  }

  template <typename T>
  std::vector<T>
  TableFile<T>::read(const MPI_Comm    &comm,
                     const std::string &path,
                     const std::uint64_t offset,
                     const std::uint64_t n)
  {
    std::vector<T> part(n);
    MPI_Count      n_read = 0;
    with_file(comm, path, MPI_MODE_RDONLY, [&](MPI_File &file) {
      MPI_Status status;
      const int  code = Utilities::MPI::LargeCount::File_read_at_all_c(
        file, offset * sizeof(T), part.data(), n, mpi_type<T>(), &status);
      MPI_Get_elements_x(&status, mpi_type<T>(), &n_read);
      return code;
    });
    throw_first(comm,
                static_cast<std::uint64_t>(n_read) == n ?
                  "" :
                  "The file \"" + path + "\" is too short.");
    return part;
  }

  template class TableFile<double>;
  template class TableFile<int>;
} // namespace treacle
