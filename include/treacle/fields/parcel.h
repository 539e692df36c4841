// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_parcel_h
#define treacle_fields_parcel_h

#include <treacle/base/types.h>

#include <deal.II/base/mpi.h>

namespace treacle
{
  /// Some liquid that moves as one.
  template <int dim>
  struct Parcel
  {
    Point<dim> position; ///< of its centroid (m)
    double     volume;   ///< m^dim

    /// For messages: position, then volume.
    using Numbers = std::array<double, dim + 1>;

    Numbers
    numbers() const
    {
      Numbers n;
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = position[d];
      n[dim] = volume;
      return n;
    }

    static Parcel
    from(const double *n)
    {
      Parcel parcel;
      for (unsigned int d = 0; d < dim; ++d)
        parcel.position[d] = n[d];
      parcel.volume = n[dim];
      return parcel;
    }
  };

  /// Volume of parcels, or of other parts that have one, over all ranks (m^dim). Collective.
  template <typename Part>
  double
  sum(const std::vector<Part> &parts, const MPI_Comm &comm)
  {
    double volume = 0;
    for (const Part &part : parts)
      volume += part.volume;
    return Utilities::MPI::sum(volume, comm);
  }

  /// What those take that have less than none, as drains do (m^dim). Collective.
  template <int dim>
  double
  taken(const std::vector<Parcel<dim>> &parcels, const MPI_Comm &comm)
  {
    double volume = 0;
    for (const Parcel<dim> &parcel : parcels)
      volume += std::max(0., -parcel.volume);
    return Utilities::MPI::sum(volume, comm);
  }
} // namespace treacle

#endif
