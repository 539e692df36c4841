// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ask.h>
#include <treacle/mesh/last_location.h>
#include <treacle/mesh/locator.h>
#include <treacle/mesh/same_faces.h>

namespace treacle
{
  namespace
  {
    /// The value of the face with this centre, along the normal, if the cell has it.
    template <int dim>
    Tensor<1, dim>
    value_at_centre(const Mesh<dim> &mesh, const Vector &values, const LocalIndex cell, const Point<dim> &centre)
    {
      constexpr double rounding = 1e-8;
      for (const LocalIndex f : mesh.cell_faces[cell])
        if (mesh.face_centre[f].distance(centre) < rounding * mesh.cell_size[cell])
          return values.local_element(f) * mesh.face_normal[f];
      return {};
    }
  } // namespace

  template <int dim>
  std::vector<double>
  values_of_same_faces(const Mesh<dim>               &mesh,
                       const Vector                  &values,
                       const Mesh<dim>               &other,
                       const std::vector<LocalIndex> &faces)
  {
    std::vector<double>       result(faces.size());
    std::vector<unsigned int> elsewhere, ranks;
    std::vector<Point<dim>>   asked;
    LastLocation<dim>         last(mesh);
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        const Point<dim> &x    = other.face_centre[faces[i]];
        const LocalIndex  cell = mesh.locator().locate(x, last.guess(x)).cell;
        last.set(x, cell);
        if (cell != invalid)
          result[i] = value_at_centre(mesh, values, cell, x) * other.face_normal[faces[i]];
        else
          {
            elsewhere.push_back(i);
            asked.push_back(x);
          }
      }
    for (const auto &owner : mesh.locator().owners_elsewhere(asked))
      ranks.push_back(owner.rank);
    const std::vector<double> heard =
      ask(mesh.communicator(), ranks, asked, dim, [&](const Point<dim> &x, double *answer) {
        const Tensor<1, dim> value = value_at_centre(mesh, values, mesh.locator().locate_here(x).cell, x);
        std::copy_n(value.begin_raw(), dim, answer);
      });
    for (unsigned int i = 0; i < elsewhere.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        result[elsewhere[i]] += heard[i * dim + d] * other.face_normal[faces[elsewhere[i]]][d];
    return result;
  }

  template std::vector<double>
  values_of_same_faces(const Mesh<2> &, const Vector &, const Mesh<2> &, const std::vector<LocalIndex> &);
  template std::vector<double>
  values_of_same_faces(const Mesh<3> &, const Vector &, const Mesh<3> &, const std::vector<LocalIndex> &);
} // namespace treacle
