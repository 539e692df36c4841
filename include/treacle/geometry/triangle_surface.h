// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_triangle_surface_h
#define treacle_geometry_triangle_surface_h

#include <treacle/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <mpi.h>

#include <memory>
#include <string>

namespace treacle
{
  /// How a surface file is brought into the scene, in the order of the members.
  struct Placement
  {
    bool         centre_at_origin = false; // the centre of the bounding box
    double       scale            = 1;
    Tensor<1, 3> axis             = Point<3>::unit_vector(2); // any length
    double       angle            = 0;                        // rad, right hand
    Tensor<1, 3> translation;                                 // m
  };



  /// A closed surface of triangles read from a file (OFF, OBJ, PLY, STL), with
  /// its signed distance. Inside is what an odd number of crossings separates
  /// from infinity, so cavities are outside however they are oriented.
  class TriangleSurface
  {
  public:
    /// The first rank reads the file. @p where names the parameter in messages. Throws a
    /// UserError on all ranks if it cannot be read or the surface is not closed. Collective.
    TriangleSurface(const std::string &file,
                    const Placement   &placement,
                    const std::string &where,
                    const MPI_Comm    &comm = MPI_COMM_SELF);
    ~TriangleSurface();

    /// Distance (m) to the nearest triangle, negative inside.
    double
    signed_distance(const Point<3> &x) const;

    /// The same where the surface is nearer than @p reach (m); else a number of its sign, no nearer than that, no farther than it is. For
    /// points that lie close together: what is found about cubes of them is kept. With no reach only the box around it is asked.
    double
    distance_within(const Point<3> &x, const double reach) const;

    const BoundingBox<3> &
    bounding_box() const;

    unsigned int
    n_vertices() const;

    unsigned int
    n_triangles() const;

  private:
    struct Implementation;
    std::unique_ptr<const Implementation> implementation;
  };
} // namespace treacle

#endif
