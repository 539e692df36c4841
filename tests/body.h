// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_body_h
#define treacle_tests_body_h

#include "tests.h"
#include "run_scene.h"

#include <treacle/dynamics/measures.h>
#include <treacle/surface/redistance.h>
#include <treacle/transport/initial_mesh.h>

namespace tests
{
  /// Text of the settings among the arguments, for every Body.
  inline std::string &
  settings()
  {
    static std::string text;
    return text;
  }

  /// The arguments of a program; those like "Section/Name=value" become settings.
  inline std::vector<std::string>
  arguments(const int argc, char **argv)
  {
    std::vector<std::string> result;
    for (const std::string &argument : std::vector<std::string>(argv + 1, argv + argc))
      if (const auto equals = argument.find('='); equals == std::string::npos)
        result.push_back(argument);
      else
        {
          std::string line = "set " + argument.substr(0, equals) + " = " + argument.substr(equals + 1);
          std::string end  = "\n";
          for (auto slash = line.find('/'); slash < line.find('='); slash = line.find('/'))
            {
              line = "subsection " + line.substr(4, slash - 4) + "\nset " + line.substr(slash + 1);
              end += "end\n";
              settings() += line.substr(0, line.find('\n') + 1);
              line = line.substr(line.find('\n') + 1);
            }
          settings() += line + end;
        }
    return result;
  }

  /// Levels among arguments, after the dimension.
  inline std::vector<unsigned int>
  levels(const std::vector<std::string> &arguments, const unsigned int first)
  {
    std::vector<unsigned int> result;
    for (unsigned int i = first; i < arguments.size(); ++i)
      result.push_back(std::stoi(arguments[i]));
    return result;
  }

  using CheckOfLevels = void (*)(const MPI_Comm &, const std::vector<unsigned int> &);

  /// A dimension and levels among the arguments are for a person; without them the test runs
  /// on 1, 2 and 3 ranks.
  template <typename Test>
  void
  run(const int argc, char **argv, const CheckOfLevels in_two, const CheckOfLevels in_three, const Test &test)
  {
    const auto arguments = tests::arguments(argc, argv);
    const auto levels    = tests::levels(arguments, 1);
    if (levels.empty())
      on_1_2_3_ranks(test);
    else if (arguments[0] == "2")
      in_two(MPI_COMM_WORLD, levels);
    else
      in_three(MPI_COMM_WORLD, levels);
  }

  /// A body of liquid as a parameter text describes it, for single steps.
  template <int dim>
  struct Body
  {
    Body(const MPI_Comm &comm, const std::string &text, const unsigned int n_solids = 0)
      : prm(parse<dim>(text + settings(), n_solids))
      , scene(prm.scene)
      , state(make_state(comm))
      , data(*state.mesh, scene)
      , domain(prm.liquid_domain, state, data)
      , fit(prm.dynamics.face_fit, domain)
    {}

    /// A mesh full of liquid.
    Body(const std::shared_ptr<const Mesh<dim>> &mesh, const std::string &text)
      : prm(parse<dim>(text + settings(), 0))
      , scene(prm.scene)
      , state(full(mesh))
      , data(*state.mesh, scene)
      , domain(prm.liquid_domain, state, data)
      , fit(prm.dynamics.face_fit, domain)
    {}

    /// Set the face velocity to that of a field.
    void
    set_velocity(const std::function<Tensor<1, dim>(const Point<dim> &)> &velocity)
    {
      const Mesh<dim> &mesh = *state.mesh;
      state.u.zero_out_ghost_values();
      for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
        state.u.local_element(f) = velocity(mesh.face_centre(f)) * mesh.face_normal[f];
      state.u.update_ghost_values();
    }

    typename Simulator<dim>::Parameters prm;
    Scene<dim>                          scene;
    State<dim>                          state;
    MeshData<dim>                       data;
    LiquidDomain<dim>                   domain;
    FaceFit<dim>                        fit;

  private:
    static State<dim>
    full(const std::shared_ptr<const Mesh<dim>> &mesh)
    {
      State<dim> result(mesh);
      result.phi = -1;
      result.phi.update_ghost_values();
      return result;
    }

    State<dim>
    make_state(const MPI_Comm &comm)
    {
      State<dim>       result(prm.imported.is_imported() ?
                                std::make_shared<const Mesh<dim>>(comm, prm.imported.file) :
                                initial_mesh<dim>(comm, prm.mesh, scene));
      const Mesh<dim> &mesh = *result.mesh;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        result.phi.local_element(node) = scene.liquid_distance(mesh.node_position[node]);
      result.phi.update_ghost_values();
      redistance(result, 6 * mesh.finest_size());
      return result;
    }
  };

  struct Loss
  {
    double angular_momentum, kinetic_energy, linear_momentum; ///< relative
  };

  /// With a Minimum theta that the mapping bears.
  inline std::string
  with_mapping(const std::string &mapping)
  {
    return "subsection Viscosity\nset Mapping = " + mapping + "\nend\n" +
           (mapping == "face coupled" ? "subsection Pressure\nset Minimum theta = 1e-4\nend\n" : "");
  }

  /// Parameters of a free body that rotates and moves as a rigid one (case A1).
  template <int dim>
  std::string
  rigid_rotation(const std::string &mapping)
  {
    return std::string("subsection Material\nset Viscosity = 1000\nend\n"
                       "subsection Liquid 1\nset Radius = 0.3\nset Centre = ") +
           (dim == 2 ? "0.503, 0.491\nset Velocity = 0.3 - (y - 0.491); 0.2 + (x - 0.503)" :
                       "0.503, 0.491, 0.512\nset Velocity = 0.3 - (y - 0.491) + 0.5 * (z - 0.512); "
                       "0.2 + (x - 0.503); -0.5 * (x - 0.503)") +
           "\nend\n" + with_mapping(mapping) +
           // face coupled reaches 1.6e-13: its residual is found by way of the faces
           tolerance(mapping == "face coupled" ? "1e-12" : "1e-13");
  }

  /// What one viscous step takes from the initial velocity. Collective.
  template <int dim>
  Loss
  lost_by_viscosity(Body<dim> &body)
  {
    body.set_velocity([&](const Point<dim> &x) { return body.scene.initial_velocity(x); });
    body.fit.solve(body.state.u, body.state.v);
    const Measures<dim> before = measure(body.state, body.domain);
    Viscosity<dim>(body.prm.dynamics.viscosity).advance(body.state, body.fit, 0.01);
    const Measures<dim> after  = measure(body.state, body.domain);
    double              change = 0, size = 0, shift = 0, linear = 0;
    for (unsigned int k = 0; k < Motion<dim>::n_rotations; ++k)
      {
        change += std::pow(after.of_faces.angular[k] - before.of_faces.angular[k], 2);
        size += std::pow(before.of_faces.angular[k], 2);
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        shift += std::pow(after.of_faces.linear[d] - before.of_faces.linear[d], 2);
        linear += std::pow(before.of_faces.linear[d], 2);
      }
    return {std::sqrt(change / size),
            std::abs(after.of_faces.kinetic_energy / before.of_faces.kinetic_energy - 1),
            std::sqrt(shift / linear)};
  }

  /// For a person, who asks for a fine mesh.
  template <int dim>
  void
  print(const Body<dim> &body, const std::string &mapping, const Loss &loss)
  {
    const Mesh<dim> &mesh = *body.state.mesh;
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      std::cout << dim << "D, " << mapping << ", " << mesh.cells->size()
                << " cells: angular momentum lost " << loss.angular_momentum
                << ", kinetic energy " << loss.kinetic_energy << std::endl;
  }

  /// The subsection of a mesh that is two levels coarser away from the surface.
  inline std::string
  graded_mesh(const unsigned int level)
  {
    return "subsection Mesh\nset Surface level = " + std::to_string(level) +
           "\nset Interior level = " + std::to_string(level - 2) +
           "\nset Air level = 1\nset Band width = 2\nend\n";
  }

  /// Unknowns of the nodes without any order, the same on any number of ranks.
  template <int dim>
  treacle::Vector
  disorder(const Body<dim> &body, const double phase)
  {
    const NodeSystem<dim> &system = body.fit.system;
    treacle::Vector        result = system.unknowns(body.state.v);
    for (unsigned int i = 0; i < result.locally_owned_size(); ++i)
      {
        const Point<dim> &x     = body.domain.mesh.node_position[system.nodes()[i / dim]];
        result.local_element(i) = std::sin(1000 * x.norm_square() + 77 * x[0] + i % dim + phase);
      }
    return result;
  }
} // namespace tests

#endif
