// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ask.h>
#include <treacle/mesh/last_location.h>
#include <treacle/mesh/locator.h>
#include <treacle/mesh/same_faces.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    /// The normal of a face, zero if there is none, and its value along that.
    template <int dim>
    using NormalAndValue = std::array<double, dim + 1>;

    template <int dim>
    NormalAndValue<dim>
    face_with_centre(const Mesh<dim> &mesh, const Vector &values, const LocalIndex cell, const Point<dim> &centre)
    {
      constexpr double    rounding = 1e-8;
      NormalAndValue<dim> result{};
      for (const LocalIndex f : mesh.cell_faces[cell])
        if (mesh.face_centre(f).distance(centre) < rounding * mesh.cell_size[cell])
          {
            std::copy_n(mesh.face_normal[f].begin_raw(), dim, result.begin());
            result[dim] = values.local_element(f);
          }
      return result;
    }

    /// Its value along the @p normal of the face that is to be the same: edges of lattices cross in their middle.
    template <int dim>
    double
    value_along(const Tensor<1, dim> &normal, const double *face, const double missing)
    {
      constexpr double rounding = 1e-8;
      const double     cosine   = std::inner_product(normal.begin_raw(), normal.end_raw(), face, 0.);
      return std::abs(cosine) > 1 - rounding ? cosine * face[dim] : missing;
    }
  } // namespace

  template <int dim>
  std::vector<double>
  values_of_same_faces(const Mesh<dim>               &mesh,
                       const Vector                  &values,
                       const Mesh<dim>               &other,
                       const std::vector<LocalIndex> &faces,
                       const double                   missing)
  {
    const Locator<dim>       &locator = mesh.locator();
    std::vector<double>       result(faces.size());
    std::vector<unsigned int> elsewhere, ranks;
    std::vector<Point<dim>>   asked;
    LastLocation<dim>         last(mesh);
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        const Point<dim> &x    = other.face_centre(faces[i]);
        const LocalIndex  cell = locator.locate(x, last.guess(x)).cell;
        last.set(x, cell);
        if (cell != invalid)
          result[i] = value_along(other.face_normal[faces[i]], face_with_centre(mesh, values, cell, x).data(), missing);
        else
          {
            elsewhere.push_back(i);
            asked.push_back(x);
          }
      }
    for (const auto &owner : locator.owners_elsewhere(asked))
      ranks.push_back(owner.rank);
    const std::vector<double> heard =
      ask(mesh.communicator(), ranks, asked, dim + 1, [&](const Point<dim> &x, double *answer) {
        const auto face = face_with_centre(mesh, values, locator.locate_here(x).cell, x);
        std::copy(face.begin(), face.end(), answer);
      });
    for (unsigned int i = 0; i < elsewhere.size(); ++i)
      result[elsewhere[i]] = value_along(other.face_normal[faces[elsewhere[i]]], &heard[i * (dim + 1)], missing);
    return result;
  }

  template std::vector<double>
  values_of_same_faces(const Mesh<2> &, const Vector &, const Mesh<2> &, const std::vector<LocalIndex> &, const double);
  template std::vector<double>
  values_of_same_faces(const Mesh<3> &, const Vector &, const Mesh<3> &, const std::vector<LocalIndex> &, const double);
} // namespace treacle
