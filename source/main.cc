// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/scene/parameter_file.h>
#include <treacle/simulator.h>

#include <deal.II/base/logstream.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <regex>
#include <sstream>
#include <thread>

using namespace treacle;

namespace
{
  struct Options
  {
    std::string              file;
    std::vector<std::string> settings;
    bool                     resume           = false;
    bool                     check            = false;
    bool                     print_parameters = false;
    std::string              text; ///< help or version: print it and stop
  };

  bool
  is_first_rank()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  add_options(CLI::App &app, Options &options)
  {
    app.add_option("FILE", options.file, "Parameter file")->option_text("FILE.prm");
    app.add_option("--set", options.settings, "Set a parameter; may be repeated")
      ->allow_extra_args(false)
      ->option_text("'Section/Name=value'");
    app.add_flag("--resume", options.resume, "Continue from the last checkpoint");
    app.add_flag("--check",
                 options.check,
                 "Read the parameters and the scene, then stop");
    app.add_flag(
      "--print-parameters",
      options.print_parameters,
      "Print all parameters with their documentation; with FILE, as it sets them");
    app.set_version_flag("--version", "Treacle " TREACLE_VERSION);
  }

  Options
  read_command_line(const int argc, const char *const *argv)
  {
    Options  options;
    CLI::App app(
      "Treacle simulates viscous liquids with free surfaces on adaptive meshes.",
      "treacle");
    add_options(app, options);
    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::Success &success) // help or version
      {
        std::ostringstream text, unused;
        app.exit(success, text, unused);
        options.text = text.str();
        return options;
      }
    catch (const CLI::ParseError &error)
      {
        throw UserError(std::string(error.what()) +
                        " (treacle --help lists the options)");
      }
    require(
      !options.file.empty() || options.print_parameters,
      "There is no parameter file: treacle FILE.prm (treacle --help lists the options)");
    return options;
  }

  template <int dim>
  void
  run(const Options &options, const ParameterFile &file)
  {
    ParameterHandler                    prm;
    typename Simulator<dim>::Parameters parameters;
    parameters.add_parameters(prm,
                              file.count("Liquid"),
                              file.count("Solid"),
                              file.count("Emitter"),
                              file.count("Probe"));
    file.parse(prm);
    std::ostringstream text;
    prm.print_parameters(text,
                         ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
    if (options.print_parameters)
      {
        if (is_first_rank())
          std::cout << text.str() << std::flush;
        return;
      }
    Simulator<dim> simulator(MPI_COMM_WORLD, parameters, text.str());
    if (!options.check)
      simulator.run(options.resume);
    else if (is_first_rank())
      std::cout << options.file << ": ok" << std::endl;
  }

  void
  run(const Options &options)
  {
    if (!options.text.empty())
      {
        if (is_first_rank())
          std::cout << options.text << std::flush;
        return;
      }
    const ParameterFile file(MPI_COMM_WORLD, options.file, options.settings);
    if (file.dimension() == 2)
      run<2>(options, file);
    else
      run<3>(options, file);
  }

  /// What went wrong in one line, without deal.II's stack trace and frame of dashes.
  std::string
  summary(const std::exception &exception)
  {
    const std::string what = exception.what();
    const auto       *own  = dynamic_cast<const ExceptionBase *>(&exception);
    if (own == nullptr)
      return "internal error: " + what;
    std::ostringstream info;
    own->print_info(info);
    std::string place;
    std::smatch match;
    if (std::regex_search(what,
                          match,
                          std::regex("in line <([0-9]+)> of file <([^>]*)>")))
      place = " in " + match[2].str() + ":" + match[1].str();
    return "internal error" + place + ": " +
           std::regex_replace(Utilities::trim(info.str()), std::regex("\\s+"), " ");
  }

  /// Do all ranks call this within seconds? What waits for this one elsewhere never does.
  bool
  all_arrive(const MPI_Comm &meeting)
  {
    using Clock = std::chrono::steady_clock;
    // of ranks that fail each by itself the lowest speaks first, and ends the others
    const auto patience = std::chrono::milliseconds(
      5000 + 200 * std::min(Utilities::MPI::this_mpi_process(meeting), 25u));
    MPI_Request request;
    MPI_Ibarrier(meeting, &request);
    for (const auto start = Clock::now(); Clock::now() - start < patience;)
      {
        int is_done = 0;
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done)
          return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    return false;
  }

  /// The end of all ranks, whatever they wait for.
  [[noreturn]] void
  end_all(const std::string &message)
  {
    // in one piece: what mpirun has to say may come between
    std::cerr << "treacle: error: on rank " +
                   std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ": " + message + "\n"
              << std::flush;
    MPI_Abort(MPI_COMM_WORLD, 1);
    std::abort();
  }

  /// Called where an exception is thrown that nothing catches: before destructors, some of
  /// which wait for other ranks.
  [[noreturn]] void
  terminate()
  {
    std::string message = "internal error";
    try
      {
        if (std::current_exception())
          std::rethrow_exception(std::current_exception());
      }
    catch (const std::exception &exception)
      {
        message = summary(exception);
      }
    catch (...)
      {}
    // one message if all ranks fail
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    std::this_thread::sleep_for(std::chrono::milliseconds(rank == 0 ? 0 : 2000 + 200 * std::min(rank, 25u)));
    end_all(message);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::set_terminate(&terminate);
  deallog.depth_console(0);
  MPI_Comm meeting; // of ranks that have failed
  MPI_Comm_dup(MPI_COMM_WORLD, &meeting);
  int code = 0;
  try
    {
      run(read_command_line(argc, argv));
    }
  catch (const UserError &error) // on all ranks alike, or there is a mistake in the program
    {
      code = 1;
      if (!all_arrive(meeting))
        end_all(error.what());
      if (is_first_rank())
        std::cerr << "treacle: error: " << error.what() << std::endl;
    }
  MPI_Comm_free(&meeting);
  return code;
}
