// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Values of the faces that two meshes have in common, on 1, 2 and 3 ranks, which each has other parts of them: of a mesh with itself
// all, along normals that may be turned round; of one that is finer elsewhere those that it has too, others are missing: also edges that only cross in their middle.

#include <treacle/mesh/same_faces.h>

#include "../tests.h"

namespace tests::mesh_same_faces
{
using namespace treacle;

/// Fine up to @p x leaves of the finest level.
template <int dim>
Mesh<dim>
fine_up_to(const MPI_Comm &comm, const int x)
{
  typename Octree<dim>::Parameters prm;
  for (unsigned int d = 0; d < dim; ++d)
    prm.upper_corner[d] = 1;
  prm.surface_level = dim == 2 ? 5 : 4;
  return Mesh<dim>(std::make_shared<const Octree<dim>>(comm, prm, [&](const std::vector<Leaf<dim>> &leaves) {
    std::vector<bool> refine;
    for (const Leaf<dim> &leaf : leaves)
      refine.push_back(leaf.level < 2 || leaf.origin[0] < 2 * x);
    return refine;
  }));
}

/// The normal part of a linear velocity.
template <int dim>
double
flux(const Mesh<dim> &mesh, const LocalIndex face)
{
  const Point<dim> &x = mesh.face_centre(face);
  Tensor<1, dim>    v = 2 * x;
  for (unsigned int d = 0; d < dim; ++d)
    v[d] += std::sqrt(2. + d) - 0.5 * x[dim - 1 - d];
  return v * mesh.face_normal[face];
}

template <int dim>
void
check(const MPI_Comm &comm, const std::string &name, const Mesh<dim> &mesh, const Mesh<dim> &other)
{
  treacle::Vector values = mesh.zeros(mesh.faces);
  for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
    values.local_element(f) = flux(mesh, f);
  values.update_ghost_values();
  std::vector<LocalIndex> faces;
  for (LocalIndex f = 0; f < other.n_owned_faces(); f += 2)
    faces.push_back(f);
  constexpr double          missing = -7;
  const std::vector<double> found = values_of_same_faces(mesh, values, other, faces, missing);
  double                    error = 0, n_same = 0;
  for (unsigned int i = 0; i < faces.size(); ++i)
    if (found[i] != missing)
      {
        ++n_same;
        error = std::max(error, std::abs(found[i] - flux(other, faces[i])));
      }
  n_same              = Utilities::MPI::sum(n_same, comm);
  const double n_all  = Utilities::MPI::sum(1. * faces.size(), comm);
  out() << dim << "D, " << name << ": the same ones are " << std::setprecision(2) << n_same / n_all << " of the asked ones"
        << (n_same == n_all ? ", all" : "") << ", error " << (Utilities::MPI::max(error, comm) < 1e-12 ? "none" : "SOME") << std::endl;
}

template <int dim>
void
check_all(const MPI_Comm &comm)
{
  const Mesh<dim> mesh = fine_up_to<dim>(comm, 10), finer = fine_up_to<dim>(comm, dim == 2 ? 20 : 12);
  check<dim>(comm, "itself", mesh, mesh);
  check<dim>(comm, "of a coarser one", mesh, finer);
  check<dim>(comm, "of a finer one", finer, mesh);
}

void
start(int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check_all<2>(comm);
    check_all<3>(comm);
  });
}

const Test test("mesh/same_faces", start);
} // namespace tests::mesh_same_faces
