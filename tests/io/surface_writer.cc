// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The surface of a ball as PLY: closed, of the right area, with the velocity,
// and the same bytes whatever the number of ranks. An empty surface is a file too.
// Half spaces that are solid cut it off, on lattice planes and tilted: what remains
// must be closed, and its area that of a part of the ball and of a disc. A sheet of half a leaf, which
// P1 functions between nodes show as a net of 81 holes, has none. In coordinates of millions of metres the surface is what
// it is at the origin, and the files say that their points are doubles.

#include <treacle/io/surface_writer.h>

#include <map>
#include <set>
#include <sstream>

#include "../liquid.h"
#include "../run_scene.h"
#include "../tests.h"
#include "ball.h"

namespace tests::io_surface_writer
{
using namespace treacle;

std::string
read(const std::string &name)
{
  std::ifstream      file(name, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Ply
{
  std::vector<std::array<float, 6>>      vertices;
  std::vector<std::vector<std::int32_t>> facets;
};

template <int dim>
Ply
read_ply(const std::string &bytes)
{
  std::size_t n_vertices = 0, n_facets = 0;
  const auto  number = [&](const std::string &word) {
    return std::stoul(bytes.substr(bytes.find(word) + word.size()));
  };
  n_vertices    = number("element vertex ");
  n_facets      = number(dim == 2 ? "element edge " : "element face ");
  const char *p = bytes.data() + bytes.find("end_header\n") + 11;
  Ply         ply;
  ply.vertices.resize(n_vertices);
  std::memcpy(ply.vertices.data(), p, n_vertices * 24);
  p += n_vertices * 24;
  for (unsigned int k = 0; k < n_facets; ++k)
    {
      p += dim == 3 && *p == 3;
      ply.facets.emplace_back(dim);
      std::memcpy(ply.facets.back().data(), p, 4 * dim);
      p += 4 * dim;
    }
  tests::out() << (p == bytes.data() + bytes.size() ? "" : "WRONG SIZE\n");
  return ply;
}

template <int dim>
std::array<Point<dim>, dim>
points(const Ply &ply, const std::vector<std::int32_t> &facet)
{
  std::array<Point<dim>, dim> x;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int d = 0; d < dim; ++d)
      x[i][d] = ply.vertices[facet[i]][d];
  return x;
}

/// Borders of facets that are not met by a neighbour of the same orientation.
template <int dim>
unsigned int
n_open(const Ply &ply)
{
  std::map<std::vector<int>, int> borders; // +1 and -1 for its two directions
  for (const auto &facet : ply.facets)
    if (dim == 2)
      for (int i = 0; i < 2; ++i)
        borders[{facet[i]}] += 2 * i - 1;
    else
      for (int i = 0; i < 3; ++i)
        {
          const int from = facet[i], to = facet[(i + 1) % 3];
          borders[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
        }
  return std::count_if(borders.begin(), borders.end(), [](const auto &b) {
    return b.second != 0;
  });
}

template <int dim>
void
describe(const Ply &ply)
{
  double         area = 0, worst = 0;
  Tensor<1, dim> sum;
  for (const auto &facet : ply.facets)
    {
      const auto           x = points<dim>(ply, facet);
      const Tensor<1, dim> a = area_vector<dim>(x);
      area += (a * (x[0] - diagonal_point<dim>(0.5)) > -1e-12 ? 1 : -1) * a.norm();
      sum += a;
    }
  for (const auto &v : ply.vertices)
    worst = std::max({worst,
                      std::abs(v[3] - (-2 * (v[1] - 0.5) + 0.25)),
                      std::abs(v[4] - 2 * (v[0] - 0.5))});
  tests::out() << dim << "D: " << ply.vertices.size() << " vertices, "
               << ply.facets.size() << " facets, " << n_open<dim>(ply) << " open, area "
               << area << ", sum " << (sum.norm() < 1e-5 ? "0" : "not 0") << ", velocity "
               << (worst < 1e-6 ? "ok" : "WRONG") << std::endl;
}

/// The part of the ball above a plane through @p p with the normal @p n, and the disc on
/// the plane.
template <int dim>
void
describe_cut(const Ply &ply, const Point<dim> &p, const Tensor<1, dim> &n)
{
  double lowest = 1, smallest = 1, ball = 0, disc = 0;
  bool   outward = true;
  for (const auto &facet : ply.facets)
    {
      const auto           x = points<dim>(ply, facet);
      const Tensor<1, dim> a = area_vector<dim>(x);
      double               highest = -1;
      for (const auto &vertex : x)
        {
          lowest  = std::min(lowest, (vertex - p) * n);
          highest = std::max(highest, (vertex - p) * n);
        }
      smallest = std::min(smallest, a.norm());
      if (highest > 1e-6)
        ball += a.norm();
      else
        {
          disc += a.norm();
          outward = outward && a * n < 0;
        }
    }
  const double height     = (diagonal_point<dim>(0.5) - p) * n;
  const double half_width = std::sqrt(0.09 - height * height);
  const double exact_ball =
    dim == 2 ? 0.6 * std::acos(-height / 0.3) : 0.6 * numbers::PI * (0.3 + height);
  const double exact_disc = dim == 2 ? 2 * half_width : numbers::PI * half_width * half_width;
  tests::out() << dim << "D cut: " << n_open<dim>(ply) << " open, area / exact "
               << ball / exact_ball << " and " << disc / exact_disc
               << (lowest > -1e-6 ? ", above the plane" : ", BELOW THE PLANE")
               << (outward ? "" : ", TURNED") << (smallest > 0 ? "" : ", EMPTY FACETS")
               << std::endl;
}

template <int dim>
void
check_cut(const MPI_Comm &comm, const double offset, const bool is_tilted)
{
  static std::map<std::pair<double, bool>, std::string> of_one_rank;
  Tensor<1, dim>                                        normal;
  normal[dim - 1] = 1;
  if (is_tilted)
    {
      normal[0] = 0.4;
      normal[1] += 0.3;
    }
  normal /= normal.norm();
  typename Scene<dim>::Parameters parameters = tests::ball_scene<dim>();
  parameters.solids.resize(1);
  typename Shape<dim>::Parameters &solid = parameters.solids[0].shape;

  solid.kind   = ShapeKind::half_space;
  solid.normal = normal;
  solid.centre = diagonal_point<dim>(0.5) - offset * normal;
  const Scene<dim> scene(parameters);
  const State<dim> state = tests::ball_state<dim>(comm);
  SurfaceWriter<dim>({SurfaceFormat::ply}).write(state, WhereLiquidIs<dim>(state, scene).domain, "out", 1);
  if (Utilities::MPI::this_mpi_process(comm) > 0)
    return;
  const std::string bytes = read("out/frames/surface_00001.ply");
  std::string      &first = of_one_rank[{offset, is_tilted}];
  if (first.empty())
    first = bytes;
  describe_cut<dim>(read_ply<dim>(bytes), solid.centre, normal);
  tests::out() << (bytes == first ? "same file" : "DIFFERENT FILE") << std::endl;
}

template <int dim>
void
check(const MPI_Comm &comm)
{
  static std::string of_one_rank;
  State<dim>         state = tests::ball_state<dim>(comm);
  const Scene<dim>   scene(tests::ball_scene<dim>());
  const WhereLiquidIs<dim> liquid(state, scene);
  for (const SurfaceFormat format :
       {SurfaceFormat::obj, SurfaceFormat::vtp, SurfaceFormat::none, SurfaceFormat::ply})
    SurfaceWriter<dim>({format}).write(state, liquid.domain, "out", dim);
  const std::string name = "out/frames/surface_0000" + std::to_string(dim);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    {
      const std::string bytes =
        read(name + ".ply") + read(name + ".obj") + read(name + ".vtp");
      if (of_one_rank.empty())
        of_one_rank = bytes;
      describe<dim>(read_ply<dim>(read(name + ".ply")));
      tests::out() << (bytes == of_one_rank ? "same files" : "DIFFERENT FILES")
                   << std::endl;
    }
  state.phi = 1;
  state.phi.update_ghost_values();
  SurfaceWriter<dim>({SurfaceFormat::ply}).write(state, liquid.domain, "out", 0);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    tests::out() << "empty: "
                 << read_ply<dim>(read("out/frames/surface_00000.ply")).facets.size()
                 << std::endl;
}

/// Holes through a closed surface that is in one piece, by Euler's formula.
int
n_holes(const Ply &ply)
{
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto &facet : ply.facets)
    for (int i = 0; i < 3; ++i)
      edges.insert(std::minmax(facet[i], facet[(i + 1) % 3]));
  return (2 - (static_cast<int>(ply.vertices.size() + ply.facets.size()) - static_cast<int>(edges.size()))) / 2;
}

void
check_sheet(const MPI_Comm &comm)
{
  static std::string of_one_rank;
  auto parameters = parse<3>("set End time = 0.02\nset Frame interval = 0.02\nset Maximum time step = 0.02\n"
                             "subsection Mesh\nset Surface level = 4\nset Interior level = 4\nend\n"
                             "subsection Gravity\nset Acceleration = 0; 0; 0\nend\n"
                             "subsection Liquid 1\nset Shape = box\nset Lower corner = 0.2, 0.2, 0.52\n"
                             "set Upper corner = 0.8, 0.8, 0.552\nset Velocity = 0.1; 0.05; 0.31\nend\n",
                             0);
  parameters.output_directory      = "out";
  parameters.surface_writer.format = SurfaceFormat::ply;
  parameters.mesh_writer.format    = MeshFormat::none;
  parameters.checkpoint.interval   = 0;
  Simulator<3>(comm, parameters, "").run(false);
  if (Utilities::MPI::this_mpi_process(comm) > 0)
    return;
  const std::string bytes = read("out/frames/surface_00000.ply");
  if (of_one_rank.empty())
    of_one_rank = bytes;
  const Ply at_rest = read_ply<3>(bytes), moved = read_ply<3>(read("out/frames/surface_00001.ply"));
  double    area    = 0;
  for (const auto &facet : at_rest.facets)
    area += area_vector<3>(points<3>(at_rest, facet)).norm();
  tests::out() << "sheet: " << n_open<3>(at_rest) << " and " << n_open<3>(moved) << " open, holes " << n_holes(at_rest)
               << (n_holes(moved) < 8 ? ", and hardly any" : ", AND MANY") << ", area / exact "
               << area / (2 * 0.6 * 0.6 + 4 * 0.6 * 0.032) << std::endl;
  tests::out() << (bytes == of_one_rank ? "same file" : "DIFFERENT FILE") << std::endl;
}

/// Positions (m) of the vertices of a ball that is written as OBJ, from an origin; and whether all formats have doubles.
std::pair<std::vector<Point<3>>, bool>
ball_at(const MPI_Comm &comm, const double origin)
{
  const auto at = [&](const double x) {
    std::ostringstream text;
    text << std::setprecision(17) << origin + x;
    return text.str() + ", " + text.str() + ", " + text.str() + "\n";
  };
  auto parameters = parse<3>("set End time = 0\nsubsection Mesh\nset Surface level = 4\nset Interior level = 4\nend\n"
                             "subsection Domain\nset Lower corner = " + at(0) + "set Upper corner = " + at(1) +
                             "end\nsubsection Liquid 1\nset Centre = " + at(0.5) + "end\n",
                             0);
  parameters.output_directory    = "far";
  parameters.checkpoint.interval = 0;
  for (const auto format : {SurfaceFormat::ply, SurfaceFormat::vtp, SurfaceFormat::obj})
    {
      parameters.surface_writer.format = format;
      parameters.mesh_writer.format    = format == SurfaceFormat::ply ? MeshFormat::xdmf : MeshFormat::vtu;
      Simulator<3>(comm, parameters, "").run(false);
    }
  const auto has = [](const std::string &file, const std::string &text) {
    return read("far/frames/" + file).find(text) != std::string::npos;
  };
  std::istringstream    lines(read("far/frames/surface_00000.obj"));
  std::vector<Point<3>> x;
  for (std::string v; lines >> v && v == "v";)
    {
      x.emplace_back();
      lines >> x.back()[0] >> x.back()[1] >> x.back()[2];
      x.back() -= diagonal_point<3>(origin) - Point<3>();
    }
  return {x,
          has("surface_00000.ply", "property double z") && has("surface_00000.vtp", "Float64") &&
            has("mesh.xdmf", "Precision=\"8\"") && has("mesh_00000.pvtu", "Float64") &&
            has("mesh_00000.0000.vtu", "Float64")};
}

void
check_far(const MPI_Comm &comm)
{
  const auto [near, near_in_doubles] = ball_at(comm, 0);
  const auto [far, far_in_doubles]   = ball_at(comm, 4.5e6);
  double most                        = near.size() == far.size() ? 0 : 1;
  for (unsigned int k = 0; k < std::min(near.size(), far.size()); ++k)
    most = std::max(most, near[k].distance(far[k]));
  tests::out() << "far from the origin: " << (most < 1e-6 ? "the same" : "ANOTHER SURFACE") << ", in doubles "
               << near_in_doubles << " and " << far_in_doubles << std::endl;
}

void
start(const int, char **)
{
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
    for (const double offset : {0., 0.125})
      for (const bool is_tilted : {false, true})
        {
          check_cut<2>(comm, offset, is_tilted);
          check_cut<3>(comm, offset, is_tilted);
        }
    check_sheet(comm);
    check_far(comm);
  });
}

const Test test("io/surface_writer", start);
} // namespace tests::io_surface_writer
