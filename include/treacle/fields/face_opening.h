// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_face_opening_h
#define treacle_fields_face_opening_h

#include <treacle/mesh/mesh.h>
#include <treacle/scene/scene.h>

namespace treacle
{
  /// What solids and emitters leave open of faces, and how the rest moves.
  template <int dim>
  class FaceOpening
  {
  public:
    /// With the distances (m) at the nodes; no emitters: none. Refers to all.
    FaceOpening(const Mesh<dim>           &mesh,
                const Scene<dim>          &scene,
                const std::vector<double> &solid_distance,
                const std::vector<double> &emitter_distance,
                const double               time)
      : mesh(mesh)
      , scene(scene)
      , solid_distance(solid_distance)
      , emitter_distance(emitter_distance)
      , time(time)
    {}

    /// The open part of a face, and the normal velocity (m/s) of the others together; of a wall, which is all closed, what flows through all
    /// of it. Throws a UserError.
    std::pair<double, double>
    operator()(const LocalIndex face) const;

    /// The part of a face in solids where emitters are deeper, and carry it as well.
    double
    poured_in_solids(const LocalIndex face) const;

  private:
    /// Distances from the vertices of a face.
    struct Vertices
    {
      std::array<Point<dim>, dim> x;
      VertexValues<dim - 1>       solid, emitter;
    };

    Vertices
    vertices(const LocalIndex face) const;

    /// What solids alone carry: what is deeper in them than in emitters.
    double
    solid_fraction(const Vertices &v) const;

    /// What emitters carry of the @p held part: the rest.
    double
    poured_fraction(const Vertices &v, const double held) const;

    const Mesh<dim>           &mesh;
    const Scene<dim>          &scene;
    const std::vector<double> &solid_distance, &emitter_distance;
    const double               time;
  };
} // namespace treacle

#endif
