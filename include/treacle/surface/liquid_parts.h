// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_liquid_parts_h
#define treacle_surface_liquid_parts_h

#include <treacle/fields/mesh_data.h>
#include <treacle/fields/parcel.h>

namespace treacle
{
  /// The parts of the liquid that keep a volume of their own: the bodies, each connected, and what is thin about them, as sheets and
  /// jets. A P1 function that is 1 at the nodes of a part and 0 at others tells how much of some liquid is of it. Emitters at work hold
  /// their own surface, which is not to move. Partitions do not matter.
  template <int dim>
  class LiquidParts
  {
  public:
    /// Of { phi < 0 } outside solids at a time. @p data must outlive this object. Collective.
    LiquidParts(const MeshData<dim> &data, const Vector &phi, const double time);

    /// Number of parts, over all ranks.
    std::size_t
    size() const
    {
      return labels.size();
    }

    /// What each has.
    struct Measures
    {
      std::vector<double> volume; ///< of liquid (m^dim)
      std::vector<double> area;   ///< of the surface, as far as it may move (m^(dim-1))
      std::vector<double> shared; ///< volume in cells where another one has some too (m^dim)
    };

    /// With the phi that they were found with.
    const Measures &
    measures() const
    {
      return at_first;
    }

    /// With another @p phi, which is close. Collective.
    Measures
    measures(const Vector &phi) const;

    /// How much of some liquid has come to each (m^dim); what is near none is left out. Collective.
    std::vector<double>
    received(const std::vector<Parcel<dim>> &parcels) const;

    /// What has a value (m) for each part at a node, owned or ghost; 0 in emitters, and where no part is within a few cells. A single part
    /// has all nodes.
    double
    at_node(const LocalIndex node, const std::vector<double> &of_parts) const
    {
      return is_held[node] || part[node] == size() ? 0. : of_parts[part[node]];
    }

    /// Linear between the nodes. Collective.
    std::vector<double>
    at(const std::vector<Point<dim>> &x, const std::vector<double> &of_parts) const;

  private:
    /// Emitters hold these.
    void
    find_held();

    /// Nodes of thick liquid.
    Vector
    thick_nodes(const Vector &phi) const;

    /// One for each connected set of liquid nodes that are all thick, or all thin.
    Vector
    labels_of(const Vector &phi, const Vector &is_thick) const;

    /// Nodes without a label, some layers around those that have one, take it from the one with the lowest phi beside them.
    void
    spread(Vector &label, const Vector &phi) const;

    /// The labels there are, and the parts of nodes. Collective.
    void
    number(const Vector &label);

    /// Call @p visit with the part of each vertex of a cell that has one, and its share of what is at barycentric coordinates.
    template <typename Visit>
    void
    share(const LocalIndex cell, const VertexValues<dim> &lambda, const Visit &visit) const;

    /// Has a cell vertices of several parts?
    bool
    is_shared(const LocalIndex cell) const;

    const MeshData<dim>     &data;
    const Mesh<dim>         &mesh;
    const double             time;
    std::vector<double>      labels; ///< of all parts, ascending
    Measures                 at_first;
    // of nodes, owned and ghost
    std::vector<std::size_t>   part; ///< size(): none
    std::vector<unsigned char> is_held;
  };
} // namespace treacle

#endif
