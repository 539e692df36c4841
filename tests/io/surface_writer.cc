// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The surface of a ball as PLY: closed, of the right area, with the velocity,
// and the same bytes whatever the number of ranks. An empty surface is a file too.

#include <treacle/io/surface_writer.h>

#include <map>
#include <sstream>

#include "../tests.h"
#include "ball.h"

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
void
describe(const Ply &ply)
{
  double                          area = 0, worst = 0;
  Tensor<1, dim>                  sum;
  std::map<std::vector<int>, int> borders; // +1 and -1 for its two directions
  for (const auto &facet : ply.facets)
    {
      std::array<Point<dim>, dim> x;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          x[i][d] = ply.vertices[facet[i]][d];
      const Tensor<1, dim> a = area_vector<dim>(x);
      area += (a * (x[0] - diagonal_point<dim>(0.5)) > -1e-12 ? 1 : -1) * a.norm();
      sum += a;
      if (dim == 2)
        for (int i = 0; i < 2; ++i)
          borders[{facet[i]}] += 2 * i - 1;
      else
        for (int i = 0; i < 3; ++i)
          {
            const int from = facet[i], to = facet[(i + 1) % 3];
            borders[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
          }
    }
  for (const auto &v : ply.vertices)
    worst = std::max({worst,
                      std::abs(v[3] - (-2 * (v[1] - 0.5) + 0.25)),
                      std::abs(v[4] - 2 * (v[0] - 0.5))});
  const auto n_open = std::count_if(borders.begin(), borders.end(), [](const auto &b) {
    return b.second != 0;
  });
  tests::out() << dim << "D: " << ply.vertices.size() << " vertices, "
               << ply.facets.size() << " facets, " << n_open << " open, area " << area
               << ", sum " << (sum.norm() < 1e-5 ? "0" : "not 0") << ", velocity "
               << (worst < 1e-6 ? "ok" : "WRONG") << std::endl;
}

template <int dim>
void
check(const MPI_Comm &comm)
{
  static std::string of_one_rank;
  State<dim>         state = tests::ball_state<dim>(comm);
  for (const char *format : {"obj", "vtp", "none", "ply"})
    SurfaceWriter<dim>({format}).write(state, "out", dim);
  const std::string name = "out/frames/surface_0000" + std::to_string(dim);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    {
      const std::string bytes =
        read(name + ".ply") + read(name + ".obj") + read(name + ".vtp");
      if (of_one_rank.empty())
        {
          of_one_rank = bytes;
          describe<dim>(read_ply<dim>(read(name + ".ply")));
        }
      tests::out() << (bytes == of_one_rank ? "same files" : "DIFFERENT FILES")
                   << std::endl;
    }
  state.phi = 1;
  state.phi.update_ghost_values();
  SurfaceWriter<dim>({"ply"}).write(state, "out", 0);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    tests::out() << "empty: "
                 << read_ply<dim>(read("out/frames/surface_00000.ply")).facets.size()
                 << std::endl;
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
  });
}
