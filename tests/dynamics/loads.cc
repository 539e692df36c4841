// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Forces on solids and walls. A box full of liquid in which one ball turns and another is
// still: forces are what changes the liquid's momentum (in a step of backward Euler), to the tolerance of the solvers, and
// torques of the viscous step with the face-fitted mappings are. Still liquid under gravity: the buoyancy of two balls. A
// drop that falls: nothing on a ball that it does not touch.

#include "../tests.h"
#include "../run_scene.h"

#include <iomanip>

namespace tests::dynamics_loads
{
namespace
{
  /// Text of a point of the box.
  template <int dim>
  std::string
  point(const double x, const double y)
  {
    return std::to_string(x) + ", " + (dim == 3 ? std::to_string(x / 2 + 0.23) + ", " : "") +
           std::to_string(y);
  }

  template <int dim>
  std::string
  box_with_balls(const unsigned int level,
                 const double       spin,
                 const std::string &more,
                 const bool         pressure = true)
  {
    const std::string turn = std::to_string(spin);
    return std::string("set End time = 0.02\nset Frame interval = 0.02\nset Time scheme = backward Euler\n"
                       "set Maximum time step = 0.01\nset Maximum CFL number = 10\n") +
           "subsection Steps\nset Surface = false\nset Advection = false\nset Pressure = " +
           (pressure ? "true" : "false") + "\nend\n" +
           "subsection Mesh\nset Surface level = " + std::to_string(level) +
           "\nset Interior level = " + std::to_string(level) + "\nset Air level = 3\nend\n" +
           "subsection Material\nset Density = 2\nset Viscosity = 3\nend\n" +
           "subsection Solid 1\nset Shape = sphere\nset Radius = 0.15\nset Centre = " +
           point<dim>(0.27, 0.31) + "\nset Centre of rotation = " + point<dim>(0.27, 0.31) +
           "\nset Angular velocity = " + (dim == 2 ? turn : "0.2 * " + turn + "; " + turn + "; 0") + "\nend\n" +
           "subsection Solid 2\nset Shape = sphere\nset Radius = 0.12\nset Centre = " +
           point<dim>(0.66, 0.55) + "\nset Centre of rotation = " + point<dim>(0.66, 0.55) + "\nend\n" +
           more + tolerance("1e-12");
  }

  /// Components of a vector in a row.
  template <int dim>
  Tensor<1, dim>
  read(const Row &row, const std::string &name, const std::string &unit)
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = row.at(name + (dim == 1 ? "" : std::string(" ") + "xyz"[d]) + " (" + unit + ")");
    return result;
  }

  /// The forces against the change of momentum in each step, relative to them.
  template <int dim>
  void
  check_balance(const MPI_Comm &comm, const std::string &mapping, const bool pressure)
  {
    constexpr unsigned int n_rotations = Load<dim>::n_rotations;
    const std::vector<Row> rows        = run_scene<dim>(
      comm,
      box_with_balls<dim>(dim == 2 ? 5 : 3,
                          1.7,
                          std::string("subsection Gravity\nset Acceleration = ") +
                            (dim == 2 ? "0; 0" : "0; 0; 0") + "\nend\nsubsection Liquid 1\nset Shape = half space\nset Centre = " +
                            point<dim>(0, 10) + "\nset Normal = " + (dim == 2 ? "0, 1" : "0, 0, 1") +
                            "\nend\nsubsection Viscosity\nset Pressure coupling = split with first projection\nset Mapping = " + mapping + "\nend\n",
                          pressure),
      2);
    const auto sides = parse<dim>(box_with_balls<dim>(3, 1.7, ""), 2).scene;
    double     error = 0, size = 0, error_of_torque = 0;
    for (unsigned int k = 1; k < rows.size(); ++k)
      {
        const Row             &row = rows[k];
        Tensor<1, dim>         force;
        Tensor<1, n_rotations> torque;
        const Tensor<1, dim>   middle = read<dim>(row, "Centre of mass", "m");
        for (const std::string body : {"Solid 1", "Solid 2", "Walls"})
          {
            const Tensor<1, dim> f = read<dim>(row, body + " force", "N");
            Point<dim>           centre;
            for (unsigned int d = 0; d < dim; ++d)
              centre[d] = 0.5;
            if (body != "Walls")
              centre = sides.solids[body == "Solid 1" ? 0 : 1].motion.centre;
            force += f;
            torque += read<n_rotations>(row, body + " torque", "N m") + moment(centre - middle, f);
            size = std::max(size, f.norm());
          }
        const auto momenta = [&](const Row &r) {
          return std::make_pair(read<dim>(r, "Linear momentum", "kg m/s"),
                                read<n_rotations>(r, "Angular momentum", "kg m^2/s"));
        };
        const double dt                = row.at("Time step size (s)");
        const auto [p, l]         = momenta(row);
        const auto [old_p, old_l] = momenta(rows[k - 1]);
        error           = std::max(error, ((p - old_p) / dt + force).norm());
        error_of_torque = std::max(error_of_torque, ((l - old_l) / dt + torque).norm());
      }
    const auto size_of = [](const double x) {
      return x < 1e-8 ? "below 1e-8" : x < 0.1 ? "below 0.1" : "too large";
    };
    out() << "  " << mapping << (pressure ? "" : " without pressure")
          << ": momentum that no force explains " << size_of(error / size) << ", angular "
          << size_of(error_of_torque / size) << std::endl;
  }

  template <int dim>
  void
  check_buoyancy(const MPI_Comm &comm)
  {
    const Row row =
      run_scene<dim>(comm,
                     box_with_balls<dim>(dim == 2 ? 5 : 3,
                                         0,
                                         std::string("subsection Liquid 1\nset Shape = half space\n") +
                                           "set Centre = " + point<dim>(0, 0.9) +
                                           "\nset Normal = " + (dim == 2 ? "0, 1" : "0, 0, 1") + "\nend\n"),
                     2)
        .back();
    for (unsigned int k = 0; k < 2; ++k)
      {
        const double radius = k == 0 ? 0.15 : 0.12;
        const double volume =
          dim == 2 ? numbers::PI * radius * radius : 4. / 3 * numbers::PI * std::pow(radius, 3);
        const std::string    solid = "Solid " + std::to_string(k + 1);
        const Tensor<1, dim> f     = read<dim>(row, solid + " force", "N") / (2 * 9.81 * volume);
        out() << "  buoyancy of " << solid << " over rho g V: " << std::setprecision(3) << f
              << ", torque over rho g V R below "
              << (read<Load<dim>::n_rotations>(row, solid + " torque", "N m").norm() /
                      (2 * 9.81 * volume * radius) <
                    1e-3 ?
                    "1e-3" :
                    "nothing")
              << std::endl;
      }
  }

  template <int dim>
  void
  check_drop(const MPI_Comm &comm)
  {
    const std::string text = "subsection Liquid 1\nset Radius = 0.12\nset Centre = " +
                             point<dim>(0.3, 0.75) + "\nend\n";
    double largest = 0;
    for (const Row &row : run_scene<dim>(comm, box_with_balls<dim>(dim == 2 ? 5 : 3, 1.7, text), 2))
      for (const auto &[name, value] : row)
        if (name.find(" force") != std::string::npos || name.find(" torque") != std::string::npos)
          largest = std::max(largest, std::abs(value));
    out() << "  largest force of a drop that touches nothing: " << largest << std::endl;
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    out() << " " << dim << "D" << std::endl;
    std::vector<std::string> mappings = {"face fitted FLIP"};
    if (dim == 2)
      mappings.insert(mappings.end(), {"face fitted PIC", "face coupled"});
    for (const std::string &mapping : mappings)
      for (const bool pressure : {false, true})
        check_balance<dim>(comm, mapping, pressure);
    check_buoyancy<dim>(comm);
    check_drop<dim>(comm);
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
  });
}

const Test test("dynamics/loads", start);
} // namespace tests::dynamics_loads
