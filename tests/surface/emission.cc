// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// What emitters pour out: against the ceiling and in the air, with a stop; the volume
// is area times velocity times time, in small steps and through faces of cells too, and the stream as thick as its emitter. One that starts late brings its own volume with it, and one
// whose container is full pours no more. What flows into walls is not poured, what a spring makes is, and drains take liquid away.
// And liquids of two viscosities that travel: the jump between them smears, with first
// order in the leaf.
// Argument: level.

#include "../liquid.h"
#include "../tests.h"
#include "../run_scene.h"

#include <treacle/surface/carried_material.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/initial_mesh.h>
#include <treacle/transport/remesh.h>

namespace tests::surface_emission
{
std::string
mesh_section(const unsigned int level, const unsigned int interior_level = 3)
{
  return "subsection Mesh\nset Surface level = " + std::to_string(level) +
         "\nset Interior level = " + std::to_string(interior_level) + "\nset Air level = 2\nset Band width = 2\nend\n";
}

/// From an emitter between two heights (m), in a box of height 1.
template <int dim>
std::vector<Row>
rows_of(const MPI_Comm     &comm,
        const std::string  &lower,
        const std::string  &upper,
        const unsigned int  level,
        const double        step)
{
  const std::string text =
    "set End time = 0.1\nset Frame interval = 10\nset Maximum time step = " + std::to_string(step) + "\n" +
    mesh_section(level) +
    "subsection Material\nset Viscosity = 100\nend\nsubsection Emitter 1\nset Shape = box\n"
    "set Lower corner = " +
    (dim == 2 ? "0.38" : "0.38, 0.34") + ", " + lower + "\nset Upper corner = " +
    (dim == 2 ? "0.63" : "0.63, 0.59") + ", " + upper + "\nset Velocity = " +
    (dim == 2 ? "0; -1" : "0; 0; -1") + "\nset Stop time = 0.07\nend\n";
  return run_scene<dim>(comm, text, 0, 0, 1);
}

template <int dim>
void
pour(const MPI_Comm &comm, const bool at_ceiling, const unsigned int level, const double step)
{
  const auto rows = at_ceiling ? rows_of<dim>(comm, "0.9", "1.1", level, step) : rows_of<dim>(comm, "0.7", "0.85", level, step);
  const std::string unit = dim == 2 ? " (m^2)" : " (m^3)";
  const double      expected = 0.07 * std::pow(0.25, dim - 1);
  const double      emitted  = rows.back().at("Emitted volume" + unit);
  const double      volume   = rows.back().at("Liquid volume" + unit);
  const double      first    = rows.front().at("Liquid volume" + unit);
  if (level > 5 && Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D " << at_ceiling << ": emitted " << emitted / expected - 1
              << ", volume " << (volume - first) / expected - 1 << std::endl;
  out() << dim << "D " << (at_ceiling ? "at the ceiling" : "in the air") << ": "
        << rows.size() - 1 << " steps, emitted/expected " << std::setprecision(4)
        << emitted / expected << ", volume drift "
        << (std::abs(rows.back().at("Volume drift")) < 1e-3 ? "below 1e-3" : "TOO LARGE")
        << std::endl;
}

/// One that ends at the ceiling pours like one that goes on beyond it, if it is a few leaves long.
template <int dim>
void
pour_from_ceiling(const MPI_Comm &comm, const unsigned int level)
{
  const auto while_pouring = [&](const std::string &upper) {
    const auto rows = rows_of<dim>(comm, "0.8", upper, level, 0.02);
    return *std::find_if(rows.rbegin(), rows.rend(), [](const Row &row) { return row.at("Time (s)") < 0.0701; });
  };
  const Row  up_to = while_pouring("1"), beyond = while_pouring("1.1");
  const auto alike = [&](const std::string &quantity, const double part) {
    return std::abs(up_to.at(quantity) / beyond.at(quantity) - 1) < part ? "alike" : "OFF";
  };
  const std::string unit = dim == 2 ? " (m^2)" : " (m^3)";
  out() << dim << "D up to the ceiling: emitted " << alike("Emitted volume" + unit, 1e-3) << ", volume "
        << alike("Liquid volume" + unit, 1e-3) << ", kinetic energy " << alike("Kinetic energy (J)", 2e-3) << std::endl;
}

/// One whose end lies along faces of cells, in 2D in the middle of leaves, in 3D across their edges, pours as any other: what it pours is not
/// lost again.
template <int dim>
void
pour_through_faces(const MPI_Comm &comm, const unsigned int level)
{
  const std::string body =
    dim == 2 ? "box\nset Lower corner = 0.38, 0.703125\nset Upper corner = 0.63, 0.85\nset Velocity = 0; -1\n" :
               "expression\nset Expression = max(max(y - z, z - y - 0.3)*sqrt(0.5), "
               "max(abs(x - 0.5) - 0.12, abs(y + z - 1)*sqrt(0.5) - 0.12))\nset Velocity = 0; 0.7; -0.7\n";
  const auto rows = run_scene<dim>(comm,
                                   "set End time = 0.1\nset Frame interval = 10\nset Maximum time step = 0.01\n" + mesh_section(level) +
                                     "subsection Gravity\nset Acceleration = " + (dim == 2 ? "0; 0" : "0; 0; 0") +
                                     "\nend\nsubsection Emitter 1\nset Shape = " + body + "end\n",
                                   0,
                                   0,
                                   1);
  const std::string unit = dim == 2 ? " (m^2)" : " (m^3)";
  double            won  = 0;
  for (const Row &row : rows)
    won += row.at("Drift before correction") * row.at("Liquid volume" + unit);
  won /= rows.back().at("Emitted volume" + unit);
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D through faces: won " << won << std::endl;
  out() << dim << "D through faces: won or lost, of what is poured, "
        << (std::abs(won) < 0.1 ? "little" : "TOO MUCH, " + std::to_string(won)) << std::endl;
}

/// On its way through the emitter a stream of three leaves' radius keeps its own, and beside it the ceiling, where it sticks; nothing
/// corrects the volume.
void
pour_round(const MPI_Comm &comm, const std::string &name, const double sideways)
{
  const auto rows = run_scene<3>(comm,
                                 "set End time = 0.16\nset Frame interval = 10\nset Maximum time step = 0.02\n" +
                                   mesh_section(4) +
                                   "subsection Domain\nset Upper corner = 0.5, 0.5, 1\nend\n"
                                   "subsection Material\nset Viscosity = 100\nend\n"
                                   "subsection Gravity\nset Acceleration = 0; 0; 0\nend\n"
                                   "subsection Surface tracking\nset Volume correction = false\nend\n"
                                   "subsection Emitter 1\nset Shape = cylinder\nset Centre = 0.26, 0.25, 1\n"
                                   "set Length = 0.4\nset Radius = 0.1\nset Velocity = " +
                                   std::to_string(sideways) + "; 0; -1\nend\n",
                                 0,
                                 0,
                                 1);
  const double poured = rows.back().at("Emitted volume (m^3)");
  const double won =
    rows.back().at("Liquid volume (m^3)") - rows.front().at("Liquid volume (m^3)") - poured;
  out() << "3D " << name << ": won or lost, of what is poured, "
        << (std::abs(won) < 0.03 * poured ? "less than 3 %" : "TOO MUCH, " + std::to_string(won / poured)) << std::endl;
}

/// A box that pours towards an edge fills all that its liquid passes in a step, not only where that begins and ends.
template <int dim>
void
pour_askew(const MPI_Comm &comm, const unsigned int level)
{
  const double      time = 0.24, slanted = std::sqrt(0.5);
  const std::string corner = dim == 2 ? "" : "0.38, ", other_corner = dim == 2 ? "" : "0.63, ", along = std::to_string(slanted);
  const auto        rows = run_scene<dim>(comm,
                                   "set End time = " + std::to_string(time) + "\nset Frame interval = 10\nset Maximum time step = 0.06\n" +
                                     mesh_section(level) + "subsection Gravity\nset Acceleration = " + (dim == 2 ? "0; 0" : "0; 0; 0") +
                                     "\nend\nsubsection Material\nset Viscosity = 1\nend\n"
                                     "subsection Emitter 1\nset Shape = box\nset Lower corner = 0.21, " +
                                     corner + "0.56\nset Upper corner = 0.46, " + other_corner + "0.81\nset Velocity = " + along +
                                     (dim == 2 ? "; -" : "; 0; -") + along + "\nend\n",
                                   0,
                                   0,
                                   1);
  const double poured = rows.back().at(dim == 2 ? "Emitted volume (m^2)" : "Emitted volume (m^3)"),
               error = poured / (time * 2 * slanted * std::pow(0.25, dim - 1)) - 1;
  out() << dim << "D askew: emitted " << (std::abs(error) < 0.015 ? "as much as flows out" : "OFF, " + std::to_string(error))
        << std::endl;
}

/// Half a ball at the ceiling, in steps of two leaves: its sides leave the ceiling upright, and bend.
template <int dim>
void
pour_from_dome(const MPI_Comm &comm, const unsigned int level)
{
  const double      end = 0.5, radius = 0.1;
  const auto        rows = run_scene<dim>(comm,
                                   "set End time = " + std::to_string(end) + "\nset Frame interval = 10\nset Maximum time step = 0.0625\n" +
                                     mesh_section(level) + "subsection Domain\nset Upper corner = 0.5, " + (dim == 2 ? "1" : "0.5, 1") +
                                     "\nend\nsubsection Gravity\nset Acceleration = 0; 0" + (dim == 2 ? "" : "; 0") +
                                     "\nend\nsubsection Material\nset Viscosity = 100\nend\nsubsection Emitter 1\nset Centre = 0.26, " +
                                     (dim == 2 ? "1" : "0.25, 1") + "\nset Radius = " + std::to_string(radius) + "\nend\n",
                                   0,
                                   0,
                                   1);
  const double poured = rows.back().at(dim == 2 ? "Emitted volume (m^2)" : "Emitted volume (m^3)"),
               error  = poured / (end * (dim == 2 ? 2 * radius : numbers::PI * radius * radius)) - 1;
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D from a dome: emitted/expected " << 1 + error << std::endl;
  out() << dim << "D from a dome: emitted " << (std::abs(error) < 0.02 ? "as much as flows out" : "OFF, " + std::to_string(error)) << std::endl;
}

/// A ball that pours with some velocity, its centre at a height; what is counted is what there is more in the end, of which nothing is corrected.
template <int dim>
void
pour_from_ball(const MPI_Comm &comm, const std::string &name, const std::string &velocity, const double height, const bool on_solid, const unsigned int level)
{
  const double      radius = 0.15, end = 0.05;
  const std::string beside = dim == 2 ? "0.5, " : "0.5, 0.5, ";
  const auto        rows   = run_scene<dim>(
    comm,
    "set End time = " + std::to_string(end) + "\nset Frame interval = 10\nset Maximum time step = 0.01\n" + mesh_section(level) +
      "subsection Gravity\nset Acceleration = " + (dim == 2 ? "0; 0" : "0; 0; 0") +
      "\nend\nsubsection Material\nset Viscosity = 10\nend\nsubsection Surface tracking\nset Volume correction = false\nend\n"
      "subsection Emitter 1\nset Centre = " + beside + std::to_string(height) + "\nset Radius = " + std::to_string(radius) +
      "\nset Velocity = " + velocity + "\nend\n" +
      (on_solid ? "subsection Solid 1\nset Shape = half space\nset Centre = " + beside + std::to_string(height) + "\nset Normal = " +
                    (dim == 2 ? "0.1" : "0.1, 0.05") + ", 1\nend\n" : ""),
    on_solid,
    0,
    1);
  const std::string unit   = dim == 2 ? " (m^2)" : " (m^3)";
  const double      poured = rows.back().at("Emitted volume" + unit),
               won         = rows.back().at("Liquid volume" + unit) - rows.front().at("Liquid volume" + unit),
               whole       = end * (dim == 2 ? 2 * radius : numbers::PI * radius * radius); // of a velocity of 1 m/s
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D " << name << ": emitted " << poured / whole << ", won " << won / whole << std::endl;
  out() << dim << "D " << name << ": emitted " << (std::abs(poured - won) < 0.05 * whole + 0.05 * std::abs(won) ? "what there is more" : "OFF")
        << ", " << (poured > 0.1 * whole ? "much" : "next to nothing") << std::endl;
}

void
pour_from_balls(const MPI_Comm &comm, const unsigned int level)
{
  pour_from_ball<2>(comm, "into the floor", "0; -1", 0, false, level + 1);
  pour_from_ball<2>(comm, "into a solid", "0; -1", 0.3, true, level + 1);
  pour_from_ball<2>(comm, "into a solid askew", "1; -1", 0.3, true, level + 1);
  pour_from_ball<3>(comm, "into a solid askew", "1; 0; -1", 0.3, true, level);
  pour_from_ball<2>(comm, "from a spring", "8*(x - 0.5); 8*(y - 0.5)", 0.5, false, level + 1);
  pour_from_ball<2>(comm, "from a spring in a solid", "8*(x - 0.5); 8*(y - 0.3)", 0.3, true, level + 1);
  pour_from_ball<3>(comm, "from a spring in a solid", "8*(x - 0.5); 8*(y - 0.5); 8*(z - 0.3)", 0.3, true, level);
}

/// From a pool through the floor, or where their velocity converges; as long as it is covered volume falls by what is counted.
void
drain(const MPI_Comm &comm, const unsigned int level)
{
  const double end      = 0.2;
  const auto   taken_by = [&](const std::string &body) {
    const auto rows = run_scene<2>(comm,
                                   "set End time = " + std::to_string(end) + "\nset Frame interval = 10\nset Maximum time step = 0.02\n" +
                                     mesh_section(level) + "subsection Material\nset Viscosity = 10\nend\n"
                                     "subsection Surface tracking\nset Volume correction = false\nend\n"
                                     "subsection Liquid 1\nset Shape = half space\nset Centre = 0.5, 0.5\nset Normal = 0, 1\nend\n"
                                     "subsection Emitter 1\nset Shape = " + body + "end\n",
                                   0,
                                   1,
                                   1);
    const double counted = rows.back().at("Emitted volume (m^2)"), won = rows.back().at("Liquid volume (m^2)") - 0.5;
    return std::array<double, 2>{{-counted, won / counted - 1}};
  };
  const auto   verdict = [](const double off) { return std::abs(off) < 0.01 ? "as much as is missing" : "OFF, " + std::to_string(off); };
  const auto [through, off] = taken_by("box\nset Lower corner = 0.4, -1\nset Upper corner = 0.6, 0.1\nset Velocity = 0; -0.5\n");
  out() << "2D drain in the floor: takes " << std::setprecision(4) << through / (0.2 * 0.5 * end) << " of area times velocity times time, "
        << verdict(off) << std::endl;
  out() << "2D drain amid the liquid: takes "
        << verdict(taken_by("sphere\nset Centre = 0.5, 0.25\nset Radius = 0.1\nset Velocity = -5*(x - 0.5); -5*(y - 0.25)\n")[1]) << std::endl;
}

/// What flows into one from the air: of a stream as fast as itself, which an emitter pours, a wider one takes as much as that pours.
template <int dim>
void
take_stream(const MPI_Comm &comm, const unsigned int level, const double bound)
{
  const auto box = [](const std::string &name, const std::string &from, const std::string &width, const std::string &height) {
    const double lower = 0.5 - 0.5 * std::stod(width), upper = 1 - lower;
    const auto   sides = [](const double x) { return std::to_string(x) + ", " + (dim == 2 ? "" : std::to_string(x) + ", "); };
    return "subsection " + name + "\nset Shape = box\nset Lower corner = " + sides(lower) + from + "\nset Upper corner = " + sides(upper) + height +
           "\nset Velocity = 0; " + (dim == 2 ? "" : "0; ") + "-1\nend\n";
  };
  const double end  = 0.2;
  const auto   rows = run_scene<dim>(comm,
                                   "set End time = " + std::to_string(end) + "\nset Frame interval = 10\nset Maximum time step = 0.02\n" +
                                     mesh_section(level) + "subsection Material\nset Viscosity = 100\nend\nsubsection Gravity\nset Acceleration = 0; 0" +
                                     (dim == 2 ? "" : "; 0") + "\nend\n" + box("Liquid 1", "0", "0.2", "1") + box("Emitter 1", "0.9", "0.2", "1.1") +
                                     box("Emitter 2", "-0.1", "0.3", "0.1"),
                                   0,
                                   1,
                                   2);
  const double off = rows.back().at(dim == 2 ? "Emitted volume (m^2)" : "Emitted volume (m^3)") / (std::pow(0.2, dim - 1) * end);
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D stream into a drain: emitted " << off << std::endl;
  out() << dim << "D stream into a drain: " << rows.size() - 1 << " steps, "
        << (std::abs(off) < bound ? "as much is poured as is taken" : "OFF, " + std::to_string(off)) << std::endl;
}

/// What is full stays so, and what would be poured is not counted, but for a layer of a leaf; half a ball at the ceiling, or in 2D in a round container.
template <int dim>
void
fill_up(const MPI_Comm &comm)
{
  const std::string below = dim == 2 ? "0.15, " : "0.27, 0.25, ";
  const auto        rows  = run_scene<dim>(comm,
                                   std::string("set End time = ") + (dim == 2 ? "0.6" : "0.35") +
                                     "\nset Frame interval = 10\nset Maximum time step = 0.02\n" + mesh_section(4) +
                                     "subsection Domain\nset Upper corner = 0.5, " + (dim == 2 ? "0.5" : "0.5, 0.5") +
                                     "\nend\nsubsection Material\nset Viscosity = 5\nend\nsubsection Liquid 1\nset Shape = half space\nset Centre = " +
                                     below + (dim == 2 ? "0.4" : "0.47") + "\nset Normal = 0, " + (dim == 2 ? "1" : "0, 1") +
                                     "\nend\nsubsection Emitter 1\nset Centre = " + below + "0.5\nset Radius = 0.1\nend\n" +
                                     (dim == 2 ? "subsection Solid 1\nset Centre = 0.25, 0.28\nset Radius = 0.23\nset Invert = true\nend\n" : ""),
                                   dim == 2,
                                   1,
                                   1);
  const Row   &end    = rows.back();
  const double volume = end.at(dim == 2 ? "Liquid volume (m^2)" : "Liquid volume (m^3)"), drift = end.at("Volume drift"),
               air    = (dim == 2 ? numbers::PI * 0.23 * 0.23 : 0.125) - volume, // m^dim
               layer  = (dim == 2 ? 0.2 : numbers::PI * 0.01) / 32;             // of a leaf, as wide as the emitter
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D full: air " << air << ", a layer " << layer << ", drift " << drift << std::endl;
  out() << dim << "D filled up: the container " << (air < layer ? "is full" : "IS NOT FULL, " + std::to_string(air)) << ", emitted "
        << (std::abs(drift) * volume < layer ? "as much as is there" : "OFF, " + std::to_string(drift)) << ", and in the last step "
        << (end.at(dim == 2 ? "Emission rate (m^2/s)" : "Emission rate (m^3/s)") == 0 ? "nothing" : "MORE") << std::endl;
}

/// One that fills a channel, in 3D a quarter of a pipe beside two planes of symmetry, up to its wall; neither the wall nor its end lies on
/// sides of leaves. What it pours comes out at the other end.
template <int dim>
std::vector<Row>
rows_of_channel(const MPI_Comm &comm, const double end, const double step)
{
  const std::string along = dim == 2 ? "1; 0" : "0; 0; 1";
  const auto        body  = [&](const double end) {
    const std::string to = std::to_string(end);
    return (dim == 2 ? "set Shape = box\nset Lower corner = -1, -1\nset Upper corner = " + to + ", 0.11" :
                       "set Shape = cylinder\nset Centre = 0, 0, 0\nset Radius = 0.11\nset Length = " +
                         std::to_string(2 * end)) +
           "\nset Velocity = " + along + "\nend\n";
  };
  return run_scene<dim>(
    comm,
    "set End time = " + std::to_string(end) + "\nset Frame interval = 10\nset Maximum time step = " + std::to_string(step) + "\n" +
      mesh_section(dim == 2 ? 4 : 3) +
      "subsection Domain\nset Wall condition = free slip\nset Upper corner = " + (dim == 2 ? "0.75, 0.25" : "0.25, 0.25, 0.75") +
      "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 10\nend\n"
      "subsection Gravity\nset Acceleration = " +
      (dim == 2 ? "0; 0" : "0; 0; 0") + "\nend\nsubsection Liquid 1\n" + body(0.3) + "subsection Emitter 1\n" + body(0.06) +
      "subsection Solid 1\nset Shape = expression\nset Expression = " +
      (dim == 2 ? "max(0.11 - y, x - 0.3)" : "max(0.11 - sqrt(x*x + y*y), z - 0.3)") + "\nend\n",
    1,
    1,
    1);
}

template <int dim>
void
pour_through_channel(const MPI_Comm &comm)
{
  const auto   rows    = rows_of_channel<dim>(comm, 0.2, 0.02);
  const double section = dim == 2 ? 0.11 : numbers::PI / 4 * 0.11 * 0.11;
  const double fastest = rows.back().at("Maximum speed (m/s)") / (dim == 2 ? 1.5 : 2); // Poiseuille
  double       lost    = 0; // in a step, of what is poured
  for (const Row &row : rows)
    if (row.at("Time (s)") > 0.1)
      lost = std::max(lost,
                      std::abs(row.at("Drift before correction")) *
                        row.at(dim == 2 ? "Liquid volume (m^2)" : "Liquid volume (m^3)") /
                        (section * row.at("Time step size (s)")));
  const double bound = dim == 2 ? 0.02 : 0.08; // of seven leaves, of three and a half
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D through a channel: lost " << lost << ", fastest " << fastest << std::endl;
  out() << dim << "D through a channel: speed " << (std::abs(fastest - 1) < 0.02 ? "as Poiseuille's" : "OFF")
        << ", won or lost in a step " << (lost < bound ? "little" : "TOO MUCH") << std::endl;
}

/// In steps of a thousandth of a leaf it pours no more.
template <int dim>
void
creep_through_channel(const MPI_Comm &comm)
{
  const double end = 1e-4, section = dim == 2 ? 0.11 : numbers::PI / 4 * 0.11 * 0.11;
  const auto   rows   = rows_of_channel<dim>(comm, end, 2e-5);
  const double poured = rows.back().at(dim == 2 ? "Emitted volume (m^2)" : "Emitted volume (m^3)") / (section * end);
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D creeping through a channel: emitted/expected " << poured << std::endl;
  const double bound = dim == 2 ? 0.05 : 0.15; // of seven leaves, of three and a half
  out() << dim << "D creeping through a channel: emitted " << (std::abs(poured - 1) < bound ? "as expected" : "OFF") << std::endl;
}

/// Above a pool, in the air until it starts; nothing corrects the volume.
void
pour_late(const MPI_Comm &comm)
{
  const auto rows = run_scene<2>(
    comm,
    "set End time = 0.08\nset Frame interval = 10\nset Maximum time step = 0.02\n" + mesh_section(5) +
      "subsection Material\nset Viscosity = 100\nend\nsubsection Surface tracking\n"
      "set Volume correction = false\nend\nsubsection Liquid 1\nset Shape = half space\n"
      "set Centre = 0.5, 0.2\nset Normal = 0, 1\nend\nsubsection Emitter 1\nset Shape = box\n"
      "set Lower corner = 0.4, 0.7\nset Upper corner = 0.6, 0.9\nset Velocity = 0; -0.5\n"
      "set Start time = 0.04\nend\n",
    0,
    1,
    1);
  out() << "2D late: emitted/expected " << std::setprecision(3)
        << rows.back().at("Emitted volume (m^2)") / (0.2 * 0.2 + 0.04 * 0.2 * 0.5) << ", volume drift "
        << (std::abs(rows.back().at("Volume drift")) < 5e-3 ? "below 5e-3" : "TOO LARGE") << std::endl;
}

/// A light, thin and a heavy, thick half of a block move together.
template <int dim>
void
carry(const MPI_Comm &comm, const unsigned int level)
{
  const std::string text =
    mesh_section(level, level) +
    "subsection Material\nset Transport = advected\nset Viscosity = 100\nend\n"
    "subsection Liquid 1\nset Shape = box\nset Lower corner = " +
    (dim == 2 ? "0.1, 0.3" : "0.1, 0.3, 0.3") + "\nset Upper corner = " +
    (dim == 2 ? "0.35, 0.7" : "0.35, 0.7, 0.7") +
    "\nset Viscosity = 1 + 2*y\nset Density = 500\nend\n"
    "subsection Liquid 2\nset Shape = box\nset Lower corner = " +
    (dim == 2 ? "0.35, 0.3" : "0.35, 0.3, 0.3") + "\nset Upper corner = " +
    (dim == 2 ? "0.6, 0.7" : "0.6, 0.7, 0.7") + "\nend\n";
  const auto                          prm = parse<dim>(text, 0, 2);
  const Scene<dim>                    scene(prm.scene);

  auto             state = std::make_unique<State<dim>>(initial_mesh<dim>(comm, prm.mesh, scene));
  for (LocalIndex node = 0; node < state->mesh->n_owned_nodes(); ++node)
    state->phi.local_element(node) = scene.liquid_distance(state->mesh->node_position[node]);
  state->phi.update_ghost_values();
  const MeshData<dim> data(*state->mesh, scene);
  set_initial_material(*state, data);
  settle_material(*state, data, 6);
  const unsigned int n_steps = 10;
  Tensor<1, dim>     travelled;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      for (LocalIndex node = 0; node < state->mesh->n_owned_nodes(); ++node)
        {
          Tensor<1, dim> v;
          v[0] = 1;
          v[1] = 0.5;
          state->v.set(node, v);
        }
      state->v.update_ghost_values();
      const WhereLiquidIs<dim>          liquid(*state, scene);
      const SurfaceGeometry<dim> surface(state->mesh, state->phi);
      const Advection<dim>       advection(
        prm.transport.advection, *state, liquid.domain, surface, BackwardDifference(0.02, *state));
      const auto mesh = mesh_for_next_surface(
        *state, liquid.domain, surface, advection, advection.move_surface(surface.facets.positions), {}, 0.02);
      auto next = std::make_unique<State<dim>>(advection.advance(mesh, 0.3));
      settle_material(*next, MeshData<dim>(*mesh, scene), 6);
      state = std::move(next);
    }
  travelled[0] = 0.02 * n_steps;
  travelled[1] = 0.01 * n_steps;

  const WhereLiquidIs<dim>        liquid(*state, scene);
  const LiquidDomain<dim> &domain = liquid.domain;
  double mean = 0, largest = 0, total = 0;
  for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
    if (domain.liquid_volume[c] > 0)
      {
        const Point<dim> start = domain.liquid_centre[c] - travelled;
        const double     mu    = start[0] < 0.35 ? 1 + 2 * start[1] : 100;
        const double     error = std::abs(domain.viscosity[c] - mu) / 100;
        total += domain.liquid_volume[c];
        mean += error * domain.liquid_volume[c];
        largest = std::max(largest, domain.viscosity[c]);
      }
  largest = Utilities::MPI::max(largest, comm);
  mean  = Utilities::MPI::sum(mean, comm) / Utilities::MPI::sum(total, comm);
  if (level > 5 && Utilities::MPI::this_mpi_process(comm) == 0)
    std::cout << dim << "D: mean error " << mean << std::endl;
  out() << dim << "D: viscosity at most " << std::setprecision(4) << largest
        << ", mean error over the jump " << std::setprecision(2) << mean << std::endl;
}

void
start(const int argc, char **argv)
{
  const unsigned int level = argc > 1 ? std::stoi(argv[1]) : 4;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const bool at_ceiling : {true, false})
      {
        pour<2>(comm, at_ceiling, level + 1, 0.02);
        pour<3>(comm, at_ceiling, level, 0.02);
      }
    pour<2>(comm, true, level + 1, 0.005); // a sixth of a leaf, a twelfth in 3D
    pour<3>(comm, true, level, 0.005);
    pour_from_ceiling<2>(comm, level + 1);
    pour_from_ceiling<3>(comm, level);
    pour_through_faces<2>(comm, level + 1);
    pour_through_faces<3>(comm, level);
    pour_round(comm, "straight", 0);
    pour_round(comm, "a little askew", 0.15);
    pour_askew<2>(comm, level + 1);
    pour_askew<3>(comm, level);
    pour_from_dome<2>(comm, level);
    pour_from_dome<3>(comm, level);
    pour_from_balls(comm, level);
    drain(comm, level + 1);
    take_stream<2>(comm, level + 2, 0.01);
    take_stream<3>(comm, level, 0.04);
    fill_up<2>(comm);
    fill_up<3>(comm);
    pour_through_channel<2>(comm);
    pour_through_channel<3>(comm);
    creep_through_channel<2>(comm);
    creep_through_channel<3>(comm);
    pour_late(comm);
    carry<2>(comm, level + 1);
    carry<3>(comm, level);
  });
}

const Test test("surface/emission", start);
} // namespace tests::surface_emission
