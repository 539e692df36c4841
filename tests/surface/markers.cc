// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Bodies carried along by a prescribed velocity (case C10): what is lost of their
// volume and shape, with markers and without. For a person: arguments are the case,
// dim, level, CFL number, method and, if not the default, markers per cell.

#include "../tests.h"
#include "../run_scene.h"

#include <treacle/surface/redistance.h>
#include <treacle/fields/liquid_volume.h>
#include <treacle/fields/moved_points.h>
#include <treacle/surface/surface.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/initial_mesh.h>
#include <treacle/transport/remesh.h>

namespace tests::surface_markers
{
/// A body, and a velocity that brings it back after a period.
template <int dim>
struct Case
{
  std::string                                                     body;
  double                                                          period, speed;
  std::function<Tensor<1, dim>(const Point<dim> &, const double)> velocity;
};

template <int dim>
Case<dim>
find_case(const std::string &name)
{
  const double      pi   = numbers::PI;
  const std::string z    = dim == 3 ? "+(z-0.5)^2" : "";
  const std::string ball = "sqrt((x-0.5)^2+(y-0.75)^2" + z + ")-0.15";
  const auto        turn = [=](const Point<dim> &x, const double) {
    Tensor<1, dim> v;
    v[0] = 2 * pi * (0.5 - x[1]);
    v[1] = 2 * pi * (x[0] - 0.5);
    return v;
  };
  const bool is_drop = name == "drop"; // of a radius of one leaf of level 4
  if (is_drop || name == "translation")
    return {"sqrt((x-0.3)^2+(y-0.3)^2" + z + ")-" + (is_drop ? "1/16" : "0.15"), 1, 0.4, [](const Point<dim> &, const double t) {
              Tensor<1, dim> v;
              v[0] = v[1] = t < 0.5 ? 0.4 : -0.4;
              return v;
            }};
  if (name == "notched")
    return {"max(" + ball + ", -max(abs(x-0.5)-0.025, y-0.85))", 1, 2.5, turn};
  if (name.substr(0, 5) == "sheet") // sheet2: two leaves of level 6 thick
    return {"max(max(abs(x-0.5)-" + std::to_string(std::stod(name.substr(5)) / 128) +
              ", abs(y-0.7)-0.2)" + (dim == 3 ? ", abs(z-0.5)-0.2)" : ", -1)"),
            1,
            2.5,
            turn};
  if (name.substr(0, 6) == "thread") // thread1.8: 1.8 leaves of level 5 across, in 3D
    {
      const std::string along = "min(max(((x-0.25)*2 + (y-0.3)*1 + (z-0.35)*2)/3, 0), 0.3)";
      return {"sqrt((x-0.25-2/3*" + along + ")^2 + (y-0.3-1/3*" + along + ")^2 + (z-0.35-2/3*" + along + ")^2) - " +
                std::to_string(std::stod(name.substr(6)) / 64),
              1, 0.4, [](const Point<dim> &, const double t) {
                Tensor<1, dim> v;
                v[0] = v[1] = t < 0.5 ? 0.4 : -0.4;
                return v;
              }};
    }
  if (name == "deformation") // of a sphere, in 3D; LeVeque (1996), section 9.5, and Enright et al. (2002), section 4.2
    return {"sqrt((x-0.35)^2+(y-0.35)^2+(z-0.35)^2)-0.15", 3, 2, [=](const Point<dim> &x, const double t) {
              Tensor<1, dim> v;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  v[d] = (d == 0 ? 2 : -1) * std::cos(pi * t / 3) * std::pow(std::sin(pi * x[d]), 2);
                  for (unsigned int e = 0; e < dim; ++e)
                    v[d] *= e == d ? 1 : std::sin(2 * pi * x[e]);
                }
              return v;
            }};
  return {ball, 8, 1, [=](const Point<dim> &x, const double t) { // vortex
            Tensor<1, dim> v;
            const double   sx = std::sin(pi * x[0]), sy = std::sin(pi * x[1]);
            v[0] = -sx * sx * std::sin(2 * pi * x[1]) * std::cos(pi * t / 8);
            v[1] = sy * sy * std::sin(2 * pi * x[0]) * std::cos(pi * t / 8);
            return v;
          }};
}

/// Volumes in parts of the exact body's.
struct Errors
{
  double       volume, shape; ///< what is missing; area of the symmetric difference
  unsigned int markers, rebuilt, steps;
  double       seconds; ///< a step
  double       least, most; ///< volume shown (m^dim)
};

template <int dim>
Errors
carry(const MPI_Comm                                  &comm,
      const std::string                               &name,
      const unsigned int                               level,
      const double                                     cfl,
      const typename SurfaceTracking<dim>::Parameters &tracking_parameters)
{
  const Case<dim>                     test = find_case<dim>(name);
  typename Simulator<dim>::Parameters prm =
    parse<dim>("subsection Mesh\nset Surface level = " + std::to_string(level) +
                 "\nset Interior level = 3\nset Air level = 3\nend\nsubsection Liquid 1\n"
                 "set Shape = expression\nset Expression = " +
                 test.body + "\nend\n",
               0);
  prm.liquid_domain.minimum_theta = 0.01;
  const Scene<dim> scene(prm.scene);
  const SurfaceTracking<dim> tracking(tracking_parameters);

  auto         state = std::make_unique<State<dim>>(initial_mesh<dim>(comm, prm.mesh, scene));
  const double h     = state->mesh->finest_size(), reach = (cfl + 3) * h;
  const auto   exact = [&](const Mesh<dim> &mesh) {
    treacle::Vector phi = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      phi.local_element(node) = scene.liquid_distance(mesh.node_position[node]);
    phi.update_ghost_values();
    return phi;
  };
  state->phi = exact(*state->mesh);
  redistance(*state, reach);
  auto         data    = std::make_shared<const MeshData<dim>>(*state->mesh, scene);
  auto         surface = tracking.begin(*state, *data);
  const double volume  = liquid_volume(*data, state->phi, state->time);

  Errors             errors{0, 0, 0, 0, 0, 0, volume, volume};
  const unsigned int n =
    2 * static_cast<unsigned int>(std::ceil(0.5 * test.period * test.speed / (cfl * h)));
  const double       dt = test.period / n;
  Timer              timer(comm);
  for (; errors.steps < n; ++errors.steps)
    {
      for (LocalIndex node = 0; node < state->mesh->n_owned_nodes(); ++node)
        state->v.set(node, test.velocity(state->mesh->node_position[node], state->time + 0.5 * dt));
      state->v.update_ghost_values();
      const LiquidDomain<dim> domain(prm.liquid_domain, *state, *data);
      const Advection<dim>    advection(
        prm.transport.advection, *state, domain, *surface, BackwardDifference(dt, *state));
      const auto markers = advection.move_markers();
      const auto mesh = mesh_for_next_surface(
        *state, domain, *surface, advection, advection.move_surface(surface->facets.positions), markers, dt);
      errors.rebuilt += mesh != state->mesh;
      auto next     = std::make_unique<State<dim>>(advection.advance(mesh, reach));
      next->markers = to_owners(*mesh, markers);
      next->v.update_ghost_values();
      if (mesh != state->mesh)
        data = std::make_shared<const MeshData<dim>>(*mesh, scene);
      surface = tracking.advance(*next, *data, reach, volume, [&] { return advection.move_parcels(); });
      state   = std::move(next);
      const double shown = liquid_volume(*data, state->phi, state->time);
      errors.least       = std::min(errors.least, shown);
      errors.most        = std::max(errors.most, shown);
    }
  errors.seconds = timer.wall_time() / errors.steps;
  const Mesh<dim> &mesh = *state->mesh;
  State<dim>       wanted(state->mesh);
  wanted.phi = exact(mesh);
  tracking.begin(wanted, *data); // as it was shown at first
  for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
    {
      const auto x = mesh.cell_vertices(c);
      const auto a = mesh.values(c, state->phi), b = mesh.values(c, wanted.phi);
      errors.shape += liquid_moments<dim>(x, a, b).volume + liquid_moments<dim>(x, b, a).volume;
    }
  errors.shape   = Utilities::MPI::sum(errors.shape, comm) / volume;
  errors.volume  = liquid_volume(*data, state->phi, state->time) / volume - 1;
  errors.markers = Utilities::MPI::sum<unsigned int>(state->markers.size(), comm);
  return errors;
}

template <int dim>
void
print_for_a_person(const int argc, char **argv)
{
  using Method = typename SurfaceTracking<dim>::Method;
  typename SurfaceTracking<dim>::Parameters tracking;
  tracking.method            = argv[5] == std::string("level set") ? Method::level_set :
                                                                     Method::marker_level_set;
  if (argc > 6)
    tracking.markers_per_cell = std::stoi(argv[6]);
  tracking.volume_correction = false;
  const Errors e = carry<dim>(
    MPI_COMM_WORLD, argv[1], std::stoi(argv[3]), std::stod(argv[4]), tracking);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << argv[1] << " " << dim << "D, level " << argv[3] << ", CFL " << argv[4] << ", "
              << argv[5] << ": volume " << e.volume << ", shape " << e.shape << ", "
              << e.markers << " markers, " << e.rebuilt << " meshes in " << e.steps
              << " steps of " << e.seconds << " s; " << e.least << " to " << e.most << " m^" << dim << std::endl;
}

template <int dim>
void
check(const MPI_Comm &comm, const std::string &name, const unsigned int level)
{
  using Method = typename SurfaceTracking<dim>::Method;
  for (const auto &[method, value] :
       {std::make_pair("level set", Method::level_set),
        std::make_pair("marker level set", Method::marker_level_set)})
    {
      if (dim == 3 && value == Method::level_set)
        continue; // for time
      typename SurfaceTracking<dim>::Parameters tracking;
      tracking.method            = value;
      tracking.volume_correction = false;
      const Errors e             = carry<dim>(comm, name, level, 2, tracking);
      out() << dim << "D, " << name << ", " << method << ": volume " << std::setprecision(3)
            << e.volume << ", shape " << e.shape << std::endl;
    }
}

/// What a mesh has to show at least (parts) of a volume (m^dim).
struct Shown
{
  double part, exact;
};

/// Of a body with round ends, as long as @p length (m) between them: in 2D a disc.
template <int dim>
double
round_volume(const double radius, const double length)
{
  return numbers::PI * radius * radius * (dim == 2 ? 1 : length + 4. / 3 * radius);
}

/// A body that becomes, or is, about as thin as a leaf: how far it goes is sensitive to roundoff, so
/// only whether its volume is kept within a part, and how much of it is there.
template <int dim>
void
check_thin(const MPI_Comm             &comm,
           const std::string          &name,
           const unsigned int          level,
           const double                part,
           const std::optional<Shown> &shown = {})
{
  typename SurfaceTracking<dim>::Parameters tracking;
  tracking.volume_correction = false;
  const Errors e             = carry<dim>(comm, name, level, 2, tracking);
  out() << dim << "D, " << name << ", thin: volume "
        << (std::abs(e.volume) < part ? "kept within " : "NOT WITHIN ") << part;
  if (shown)
    out() << ", " << (e.least > shown->part * shown->exact ? "shows at least " : "DOES NOT SHOW ") << shown->part << " of it";
  out() << std::endl;
}

void
start(const int argc, char **argv)
{
  if (argc > 5)
    std::stoi(argv[2]) == 2 ? print_for_a_person<2>(argc, argv) : print_for_a_person<3>(argc, argv);
  else
    on_1_2_3_ranks([](const MPI_Comm &comm) {
      check<2>(comm, "translation", 5);
      check<2>(comm, "sheet4", 5);
      check<3>(comm, "translation", 4);
      check_thin<2>(comm, "sheet1", 6, 0.03, Shown{0.95, 0.4 / 64});
      check_thin<2>(comm, "vortex", 5, 0.15);
      check_thin<2>(comm, "notched", 5, 0.005);
      check_thin<2>(comm, "drop", 4, 0.03, Shown{0.94, round_volume<2>(1. / 16, 0)});
      check_thin<3>(comm, "drop", 4, 0.01, Shown{0.84, round_volume<3>(1. / 16, 0)});
      check_thin<2>(comm, "drop", 5, 0.005, Shown{0.99, round_volume<2>(1. / 16, 0)});
      check_thin<3>(comm, "drop", 5, 0.005, Shown{0.99, round_volume<3>(1. / 16, 0)});
      check_thin<3>(comm, "thread0.9", 5, 0.08, Shown{0.8, round_volume<3>(0.9 / 64, 0.3)});
      check_thin<3>(comm, "thread1.8", 5, 0.03, Shown{0.92, round_volume<3>(1.8 / 64, 0.3)});
    });
}

const Test test("surface/markers", start);
} // namespace tests::surface_markers
