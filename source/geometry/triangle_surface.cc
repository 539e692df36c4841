// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/geometry/kept_in_cubes.h>
#include <treacle/geometry/nearest_point.h>
#include <treacle/geometry/triangle_surface.h>

#include <deal.II/physics/transformations.h>

// polygons are cut by minimal weight: without Delaunay triangulations, in half of the time
// to compile
#define CGAL_TRIANGULATE_FACES_DO_NOT_USE_CDT2
#define CGAL_HOLE_FILLING_DO_NOT_USE_CDT2
#define CGAL_HOLE_FILLING_DO_NOT_USE_DT3

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <fstream>

namespace treacle
{
  namespace
  {
    // which side a point lies on must not depend on rounding
    using Kernel  = CGAL::Exact_predicates_inexact_constructions_kernel;
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

    /// What the first rank has, on all ranks. Collective.
    template <typename T>
    void
    broadcast(const MPI_Comm &comm, std::vector<T> &list)
    {
      std::uint64_t size = list.size();
      MPI_Bcast(&size, 1, MPI_UINT64_T, 0, comm);
      list.resize(size);
      MPI_Datatype type;
      MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type);
      MPI_Type_commit(&type);
      MPI_Bcast(list.data(), size, type, 0, comm);
      MPI_Type_free(&type);
    }

    /// The same vertices and triangles in the same order on all ranks. Collective.
    Surface
    on_all_ranks(const MPI_Comm &comm, const Surface &mesh)
    {
      std::vector<std::array<double, 3>>        points;
      std::vector<std::array<std::uint32_t, 3>> triangles;
      std::vector<std::uint32_t>                index(mesh.num_vertices());
      for (const auto v : mesh.vertices())
        {
          const Kernel::Point_3 &p = mesh.point(v);
          index[v]                 = points.size();
          points.push_back({{p.x(), p.y(), p.z()}});
        }
      for (const auto f : mesh.faces())
        {
          triangles.emplace_back();
          auto next = triangles.back().begin();
          for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
            *next++ = index[v];
        }
      broadcast(comm, points);
      broadcast(comm, triangles);

      Surface result;
      for (const auto &[x, y, z] : points)
        result.add_vertex(Kernel::Point_3(x, y, z));
      for (const auto &[a, b, c] : triangles)
        result.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
      return result;
    }
  } // namespace



  struct TriangleSurface::Implementation
  {
    explicit Implementation(Surface &&surface)
      : mesh(std::move(surface))
      , box(bounds(mesh))
      , tree(faces(mesh).first, faces(mesh).second, mesh)
      , side(tree)
      , cubes(box)
    {
      tree.build();
      tree.accelerate_distance_queries();
    }

    double
    with_sign(const double distance, const Kernel::Point_3 &p) const
    {
      return box.point_inside(to_point(p)) && side(p) == CGAL::ON_BOUNDED_SIDE ? -distance : distance;
    }

    struct FromCentre
    {
      Kernel::Point_3 nearest; ///< of the surface
      double          distance;
    };

    const auto &
    cube_of(const Point<3> &x) const
    {
      return cubes.at(x, [&](const Point<3> &centre) -> FromCentre {
        const Kernel::Point_3 p = to_cgal(centre), nearest = tree.closest_point(p);
        return {nearest, with_sign(centre.distance(to_point(nearest)), p)};
      });
    }

    const Surface        mesh;
    const BoundingBox<3> box;
    Tree                 tree;
    const Side           side;

    mutable KeptInCubes<3, FromCentre> cubes;
  };



  TriangleSurface::TriangleSurface(const std::string &file,
                                   const Placement   &placement,
                                   const std::string &where,
                                   const MPI_Comm    &comm)
  {
    Surface     mesh;
    std::string error;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      keep_error(error, [&] {
        mesh = read(file, where);
        place(placement, mesh);
      });
    throw_first(comm, error);
    implementation = std::make_unique<const Implementation>(on_all_ranks(comm, mesh));
  }

  TriangleSurface::~TriangleSurface() = default;



  double
  TriangleSurface::signed_distance(const Point<3> &x) const
  {
    const Kernel::Point_3 p = to_cgal(x);
    return implementation->with_sign(std::sqrt(implementation->tree.squared_distance(p)), p);
  }

  double
  TriangleSurface::distance_within(const Point<3> &x, const double reach) const
  {
    if (const double to_box = x.distance(nearest_point(implementation->box, x)); to_box >= reach)
      return to_box;
    const auto &[centre, known] = implementation->cube_of(x);
    const double least          = std::abs(known.distance) - centre.distance(x);
    if (least >= reach)
      return std::copysign(least, known.distance);
    const Kernel::Point_3 p        = to_cgal(x);
    const double          distance = std::sqrt(implementation->tree.squared_distance(p, known.nearest));
    return least > 0 ? std::copysign(distance, known.distance) : implementation->with_sign(distance, p);
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
