// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace treacle
{
  void
  create_directory(const MPI_Comm &comm, const std::string &directory)
  {
    std::error_code error;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      std::filesystem::create_directories(directory, error);
    throw_first(comm,
                error ? "The directory \"" + directory +
                          "\" cannot be created: " + error.message() + "." :
                        std::string());
  }

  std::string
  replace_file(const std::string &path, const std::function<void(std::ostream &)> &write)
  {
    const std::string temporary = path + ".new";
    errno                       = 0;
    std::ofstream file(temporary, std::ios::binary);
    if (file)
      write(file);
    file.close();
    if (file && std::rename(temporary.c_str(), path.c_str()) == 0)
      return "";
    const std::string reason = errno != 0 ? std::strerror(errno) : "write error";
    std::remove(temporary.c_str());
    return "The file \"" + path + "\" cannot be written: " + reason + ".";
  }

  void
  replace_file(const MPI_Comm                            &comm,
               const std::string                         &path,
               const std::function<void(std::ostream &)> &write)
  {
    const bool is_writer = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    throw_first(comm, is_writer ? replace_file(path, write) : "");
  }
} // namespace treacle
