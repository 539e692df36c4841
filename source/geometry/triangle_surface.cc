// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/triangle_surface.h>

#include <deal.II/physics/transformations.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <fstream>

namespace treacle
{
  namespace
  {
    using Kernel  = CGAL::Simple_cartesian<double>;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

    // with the triangles copied into the tree: queries do not walk the mesh
    using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface,
                                                               CGAL::Default,
                                                               CGAL::Tag_true,
                                                               CGAL::Tag_true>;
    using Tree      = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
    using Side      = CGAL::Side_of_triangle_mesh<Surface, Kernel, CGAL::Default, Tree>;

    Point<3>
    to_point(const Kernel::Point_3 &p)
    {
      return Point<3>(p.x(), p.y(), p.z());
    }

    Kernel::Point_3
    to_cgal(const Point<3> &p)
    {
      return Kernel::Point_3(p[0], p[1], p[2]);
    }

    BoundingBox<3>
    bounds(const Surface &mesh)
    {
      std::vector<Point<3>> points;
      points.reserve(mesh.number_of_vertices());
      for (const auto v : mesh.vertices())
        points.push_back(to_point(mesh.point(v)));
      return BoundingBox<3>(points);
    }

    Surface
    read(const std::string &file, const std::string &where)
    {
      const std::string quoted = where + ": the surface \"" + file + "\" ";
      require(std::ifstream(file).good(), quoted + "does not exist or cannot be opened.");

      Surface mesh;
      bool    readable = false;
      try
        {
          readable = CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(file, mesh) &&
                     CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
        }
      catch (const std::exception &)
        {}
      require(readable,
              quoted + "cannot be read as a surface: it must be an OFF, OBJ, PLY or STL "
                       "file, with that ending, in which each edge belongs to at most "
                       "two polygons.");
      require(mesh.number_of_faces() > 0, quoted + "has no triangles.");

      unsigned int n_border_edges = 0;
      for (const auto e : mesh.edges())
        n_border_edges += mesh.is_border(e);
      require(n_border_edges == 0,
              quoted + "is not closed: " + std::to_string(n_border_edges) +
                " border edges belong to one triangle only; close its holes.");
      return mesh;
    }

    void
    place(const Placement &placement, Surface &mesh)
    {
      const Point<3> centre =
        placement.centre_at_origin ? bounds(mesh).center() : Point<3>();
      const Tensor<1, 3> axis = placement.axis / placement.axis.norm();
      const Tensor<2, 3> rotation =
        Physics::Transformations::Rotations::rotation_matrix_3d(Point<3>(axis),
                                                                placement.angle);
      for (const auto v : mesh.vertices())
        mesh.point(v) = to_cgal(
          Point<3>(rotation * (placement.scale * (to_point(mesh.point(v)) - centre)) +
                   placement.translation));
    }
  } // namespace



  struct TriangleSurface::Implementation
  {
    explicit Implementation(Surface &&surface)
      : mesh(std::move(surface))
      , box(bounds(mesh))
      , tree(faces(mesh).first, faces(mesh).second, mesh)
      , side(tree)
    {
      tree.build();
      tree.accelerate_distance_queries();
    }

    const Surface        mesh;
    const BoundingBox<3> box;
    Tree                 tree;
    const Side           side;
  };



  TriangleSurface::TriangleSurface(const std::string &file,
                                   const Placement   &placement,
                                   const std::string &where)
  {
    Surface mesh = read(file, where);
    place(placement, mesh);
    implementation = std::make_unique<const Implementation>(std::move(mesh));
  }

  TriangleSurface::~TriangleSurface() = default;



  double
  TriangleSurface::signed_distance(const Point<3> &x) const
  {
    const Kernel::Point_3 p        = to_cgal(x);
    const double          distance = std::sqrt(implementation->tree.squared_distance(p));
    if (!implementation->box.point_inside(x))
      return distance;
    return implementation->side(p) == CGAL::ON_BOUNDED_SIDE ? -distance : distance;
  }



  const BoundingBox<3> &
  TriangleSurface::bounding_box() const
  {
    return implementation->box;
  }

  unsigned int
  TriangleSurface::n_vertices() const
  {
    return implementation->mesh.number_of_vertices();
  }

  unsigned int
  TriangleSurface::n_triangles() const
  {
    return implementation->mesh.number_of_faces();
  }
} // namespace treacle
