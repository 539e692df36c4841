// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/scene/parameter_file.h>
#include <treacle/simulator.h>

#include <deal.II/base/logstream.h>

#include <CLI/CLI.hpp>

#include <chrono>
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
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  deallog.depth_console(0);
  try
    {
      run(read_command_line(argc, argv));
      return 0;
    }
  catch (const UserError &error) // on all ranks alike
    {
      if (is_first_rank())
        std::cerr << "treacle: error: " << error.what() << std::endl;
      return 1;
    }
  catch (const std::exception &exception) // on any ranks; the others may be waiting
    {
      if (!is_first_rank()) // one message if the first rank fails too
        std::this_thread::sleep_for(std::chrono::seconds(2));
      std::cerr << "treacle: error: " << summary(exception) << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  return 1;
}
