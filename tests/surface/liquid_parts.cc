// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Volume correction part by part: a pool, a sheet of two leaves that stands on it and a drop beside it. The drop has become
// smaller than what has come to it, and the sheet larger: both get back what is theirs, the pool is left alone. What all miss
// is shared by their surface. One body without thin parts is one part. What a pool in a bowl misses comes at once, though its
// surface goes on in the bowl. What is thinner than a leaf, on solids than half of one, wherever it lies in its leaves and however it
// is turned; corners of what is thick are not.

#include <treacle/fields/liquid_volume.h>
#include <treacle/fields/thin_liquid.h>
#include <treacle/surface/marker_motion.h>
#include <treacle/surface/surface_tracking.h>

#include "../body.h"

namespace tests::surface_liquid_parts
{
namespace
{
  constexpr double pool = 0.3, top = 0.7, drop_x = 0.22, drop_y = 0.65, radius = 0.1; // m

  template <int dim>
  double
  to_drop(const Point<dim> &x)
  {
    Tensor<1, dim> r = x - diagonal_point<dim>(0.5);
    r[0]             = x[0] - drop_x;
    r[1]             = x[1] - drop_y;
    return r.norm() - radius;
  }

  /// A sheet two leaves of edge @p h thick; in 3D from wall to wall.
  template <int dim>
  double
  to_sheet(const Point<dim> &x, const double h)
  {
    return std::max(std::abs(x[0] - 0.6) - h, x[1] - top);
  }

  /// Volumes (m^dim).
  struct Volumes
  {
    double drop, sheet, pool;
  };

  /// The upper part of the sheet, of which the P1 function of its lower nodes has nothing, and the lower part of the pool.
  template <int dim>
  Volumes
  volumes(const State<dim> &state, const double h)
  {
    const Mesh<dim> &mesh = *state.mesh;
    Volumes          here{0, 0, 0};
    VertexValues<dim> outside;
    outside.fill(1);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        const Simplex<dim> x      = mesh.cell_vertices(c);
        const Point<dim>   middle = barycentre<dim>(x);
        const double       volume = liquid_moments<dim>(x, mesh.values(c, state.phi), outside).volume;
        if (to_drop(middle) < 3 * h)
          here.drop += volume;
        else if (middle[1] > pool + 6 * h)
          here.sheet += volume;
        else if (std::abs(middle[0] - 0.6) > 8 * h)
          here.pool += volume;
      }
    MPI_Allreduce(MPI_IN_PLACE, &here, 3, MPI_DOUBLE, MPI_SUM, mesh.communicator());
    return here;
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    const auto prm = parse<dim>(
      "subsection Mesh\nset Surface level = 5\nset Interior level = 5\nset Air level = 5\nend\n", 0);
    const Scene<dim>           scene(prm.scene);
    const SurfaceTracking<dim> tracking({});
    State<dim>                 state(initial_mesh<dim>(comm, prm.mesh, scene));
    const Mesh<dim>           &mesh = *state.mesh;
    const MeshData<dim>        data(mesh, scene);
    const double               h = mesh.finest_size();
    const auto                 set_phi = [&](const double drop_grows, const double sheet_grows, const bool is_pool_alone) {
      state.phi.zero_out_ghost_values();
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          const Point<dim> &x    = mesh.node_position[node];
          const double      thin = std::min(to_drop(x) - drop_grows, to_sheet(x, h) - (x[1] > pool + 2.5 * h ? sheet_grows : 0));
          state.phi.local_element(node) = std::min(is_pool_alone ? 1. : thin, x[1] - pool);
        }
      state.phi.update_ghost_values();
    };
    set_phi(0, 0, true);
    out() << dim << "D: " << LiquidParts<dim>(data, state.phi, 0).size() << " part of a pool, ";
    set_phi(0, 0, false);
    out() << LiquidParts<dim>(data, state.phi, 0).size() << " of it with a sheet and a drop;";
    const LiquidDomain<dim> domain(prm.liquid_domain, state, data);
    const double            volume = domain.total_volume();
    const auto              parcels = [&] { return moved_parcels<dim>(domain, VelocityInStep<dim>(state.v), 0.); };
    const Volumes           wanted  = volumes(state, h);
    state.v.update_ghost_values();

    set_phi(-0.05 * h, 0.05 * h, false);
    const Volumes before = volumes(state, h);
    tracking.settle(state, data, volume, parcels);
    const Volumes after = volumes(state, h);
    const auto    print  = [&](const std::string &name, double Volumes::*of, const double most) {
      const auto error = [&](const Volumes &now) { return 100 * (now.*of / (wanted.*of) - 1); };
      out() << " " << name << " off by " << std::setprecision(2) << error(before) << " %, then "
            << (std::abs(error(after)) < most ? "less than " : "MORE THAN ") << most << ";";
    };
    print("drop", &Volumes::drop, 0.2);
    print("sheet", &Volumes::sheet, 1);
    print("pool", &Volumes::pool, 0.02);

    set_phi(0, 0, false);
    const double more = 1e-5;
    tracking.settle(state, data, volume + more, parcels);
    const double got = liquid_volume(data, state.phi, 0) - volume;
    out() << " of what all miss " << (std::abs(got / more - 1) < 1e-2 ? "all" : "NOT ALL") << " comes" << std::endl;
  }

  template <int dim>
  void
  check_in_bowl(const MPI_Comm &comm)
  {
    const auto prm = parse<dim>("subsection Mesh\nset Surface level = 4\nset Interior level = 4\nset Air level = 4\nend\n"
                                "subsection Solid 1\nset Shape = sphere\nset Invert = true\nset Centre = " +
                                  std::string(dim == 2 ? "0.5, 0.5" : "0.5, 0.5, 0.5") + "\nset Radius = 0.3\nend\n",
                                1);
    const Scene<dim>    scene(prm.scene);
    State<dim>          state(initial_mesh<dim>(comm, prm.mesh, scene));
    const Mesh<dim>    &mesh = *state.mesh;
    const MeshData<dim> data(mesh, scene);
    const auto          volume_at = [&](const double height) {
      state.phi.zero_out_ghost_values();
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        state.phi.local_element(node) = mesh.node_position[node][1] - height;
      state.phi.update_ghost_values();
      return liquid_volume(data, state.phi, 0);
    };
    constexpr double height = 0.33;
    const double     wanted = volume_at(height), missing = 1 - volume_at(height - 0.04 * mesh.finest_size()) / wanted;
    SurfaceTracking<dim>({}).settle(state, data, wanted, [] { return std::vector<Parcel<dim>>(); });
    const double left = 1 - liquid_volume(data, state.phi, 0) / wanted;
    out() << dim << "D: a pool in a bowl misses " << std::setprecision(2) << 100 * missing << " %, then "
          << (std::abs(left) < 1e-3 * missing ? "less than a thousandth" : "MORE THAN A THOUSANDTH") << " of that" << std::endl;
  }

  /// The thin part of one body (%), the least and the most as it is moved by parts of a leaf. In its expression X is across, in leaves, Y
  /// along.
  template <int dim>
  void
  check_thin(const MPI_Comm &comm, const std::string &name, const std::string &body, const std::string &solid = "")
  {
    constexpr unsigned int level = dim == 2 ? 6 : 4, n_places = dim == 2 ? 5 : 3;
    double                 least = 100, most = 0;
    for (unsigned int k = 0; k < n_places; ++k)
      {
        const auto shape = [&](const std::string &expression) {
          std::string       text;
          const std::string scale = std::to_string(1 << level), shift = std::to_string(0.83 * k / n_places);
          for (const char c : expression)
            text += c == 'X' ? "(" + scale + "*(0.8*x+0.6*y-0.7)-" + shift + ")" :
                    c == 'Y' ? "(" + scale + "*(0.8*y-0.6*x-0.1))" :
                    c == 'Z' ? (dim == 3 ? "(" + scale + "*(z-0.5))" : "0") :
                               std::string(1, c);
          return "set Shape = expression\nset Expression = (" + text + ")/" + scale + "\nend\n";
        };
        const Body<dim> liquid(comm,
                               "subsection Mesh\nset Surface level = " + std::to_string(level) +
                                 "\nset Interior level = 3\nset Air level = 2\nend\nsubsection Liquid 1\n" + shape(body) +
                                 (solid.empty() ? "" : "subsection Solid 1\n" + shape(solid)),
                               solid.empty() ? 0 : 1);
        const double part = 100 * thin_part(liquid.domain, liquid.state.phi);
        least             = std::min(least, part);
        most              = std::max(most, part);
      }
    out() << dim << "D: " << name << " is thin by " << std::lround(least) << " to " << std::lround(most) << " %" << std::endl;
  }

  template <int dim>
  void
  check_thin(const MPI_Comm &comm)
  {
    check_thin<dim>(comm, "a sheet of 0.6 leaves", "abs(X)-0.3");
    check_thin<dim>(comm, "a sheet of 1.3 leaves", "abs(X)-0.65");
    check_thin<dim>(comm, "a film of 0.3 leaves on a solid", "X-0.3", "X");
    check_thin<dim>(comm, "a film of 1 leaf on a solid", "X-1", "X");
    check_thin<dim>(comm, "a block", "max(abs(X),max(abs(Y),abs(Z)))-4");
  }

  void
  start(const int, char **)
  {
    on_1_2_3_ranks([](const MPI_Comm &comm) {
      check<2>(comm);
      check<3>(comm);
      check_in_bowl<2>(comm);
      check_in_bowl<3>(comm);
      check_thin<2>(comm);
      check_thin<3>(comm);
    });
  }

  const Test test("surface/liquid_parts", start);
} // namespace
} // namespace tests::surface_liquid_parts
