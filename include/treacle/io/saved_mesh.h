// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_saved_mesh_h
#define treacle_io_saved_mesh_h

#include <treacle/mesh/mesh.h>

#include <functional>

namespace treacle
{
  /// Write the leaves of an octree with their weights. Throws a UserError on all ranks.
  /// Collective, as is all below.
  template <int dim>
  void
  write_leaves(const Octree<dim> &octree, const std::string &path);

  /// The octree that such a file describes, with a size factor, which the file does not hold; with the parameters of the
  /// saved one it has the same partition on the same number of ranks.
  template <int dim>
  std::shared_ptr<const Octree<dim>>
  read_octree(const MPI_Comm                         &comm,
              const std::string                      &path,
              const typename Octree<dim>::Parameters &parameters,
              const double                            size_factor);

  /// A hash of the cells, their vertices and where these lie, in the order of the cells'
  /// numbers (of a file: the order there): whatever the partition.
  template <int dim>
  std::string
  fingerprint(const Mesh<dim> &mesh);
} // namespace treacle

#endif
