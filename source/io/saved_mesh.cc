// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/io/saved_mesh.h>
#include <treacle/io/table_file.h>

#include <deal.II/base/mpi.h>

#include <cstring>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace treacle
{
  namespace
  {
    std::uint64_t
    file_size(const MPI_Comm &comm, const std::string &path)
    {
      std::uint64_t size = 0;
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        {
          std::error_code error;
          size = std::filesystem::file_size(path, error);
          if (error)
            size = 0; // the reader will complain
        }
      return Utilities::MPI::broadcast(comm, size);
    }

    /// Fowler, Noll and Vo's hash, 1a, of what is added.
    struct Hash
    {
      std::uint64_t value = 0xcbf29ce484222325ull;

      template <typename T>
      void
      add(const T &number)
      {
        unsigned char bytes[sizeof number];
        std::memcpy(bytes, &number, sizeof number);
        for (const unsigned char byte : bytes)
          value = (value ^ byte) * 0x100000001b3ull;
      }
    };
  } // namespace

  template <int dim>
  void
  write_leaves(const Octree<dim> &octree, const std::string &path)
  {
    std::vector<int> numbers;
    for (unsigned int l = 0; l < octree.n_owned_leaves(); ++l)
      {
        const Leaf<dim> &leaf = octree.leaves()[l];
        numbers.insert(numbers.end(), leaf.origin.begin(), leaf.origin.end());
        numbers.push_back(leaf.level);
        numbers.push_back(octree.leaf_weights()[l]);
      }
    TableFile<int>::write(octree.communicator(), path, numbers);
  }

  template <int dim>
  std::shared_ptr<const Octree<dim>>
  read_octree(const MPI_Comm                         &comm,
              const std::string                      &path,
              const typename Octree<dim>::Parameters &parameters,
              const double                            size_factor)
  {
    struct Saved
    {
      unsigned int level  = 0;
      unsigned int weight = 1;
    };
    const std::vector<int> numbers =
      TableFile<int>::read(comm, path, 0, file_size(comm, path) / sizeof(int));
    std::unordered_map<VertexKey, Saved> saved; // by a leaf's lowest corner
    for (std::size_t i = 0; i + dim + 1 < numbers.size(); i += dim + 2)
      {
        LatticePoint<dim> origin;
        std::copy_n(numbers.begin() + i, dim, origin.begin());
        saved[pack<dim>(origin)] = {static_cast<unsigned int>(numbers[i + dim]),
                                    static_cast<unsigned int>(numbers[i + dim + 1])};
      }
    const auto saved_of = [&](const Leaf<dim> &leaf) {
      const auto it = saved.find(pack<dim>(leaf.origin));
      return it == saved.end() ? Saved() : it->second;
    };
    return std::make_shared<const Octree<dim>>(
      comm,
      parameters,
      [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<bool> refine;
        for (const Leaf<dim> &leaf : leaves)
          refine.push_back(saved_of(leaf).level > leaf.level);
        return refine;
      },
      [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<unsigned int> weights;
        for (const Leaf<dim> &leaf : leaves)
          weights.push_back(std::max(saved_of(leaf).weight, 1u));
        return weights;
      },
      size_factor);
  }

  template <int dim>
  std::string
  fingerprint(const Mesh<dim> &mesh)
  {
    std::uint64_t sum = 0; // of hashes that hold the cell's number: no order of ranks matters
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        Hash hash;
        hash.add(static_cast<std::uint64_t>(mesh.cell_number[c]));
        for (const LocalIndex node : mesh.cell_nodes[c])
          {
            hash.add(mesh.node_key[node]);
            for (unsigned int d = 0; d < dim; ++d)
              hash.add(mesh.node_position[node][d]);
          }
        sum += hash.value;
      }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, mesh.communicator());
    std::ostringstream text;
    text << std::hex << std::setw(16) << std::setfill('0') << sum;
    return text.str();
  }

#define INSTANTIATE(dim)                                                                  \
  template void write_leaves(const Octree<dim> &, const std::string &);                   \
  template std::shared_ptr<const Octree<dim>> read_octree(                                \
    const MPI_Comm &,                                                                     \
    const std::string &,                                                                  \
    const Octree<dim>::Parameters &,                                                      \
    const double);                                                                        \
  template std::string fingerprint(const Mesh<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
