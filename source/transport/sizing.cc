// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/carried_in_cell.h>
#include <treacle/fields/gradients.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/transport/bands.h>
#include <treacle/transport/sizing.h>

namespace treacle
{
  namespace
  {
    /// Part of the depth below a surface that the level set shows there at least, if no other
    /// surface is about: a layer is thin where it is thinner than 1 + this part of the depth.
    constexpr double least_depth = 0.6;

    /// Of what the surface asks for, what leaves may be that are larger than they were.
    constexpr double too_small = 0.75;

    template <int dim>
    std::optional<Expression<dim>>
    formula(const std::string &size)
    {
      if (size.empty())
        return {};
      return Expression<dim>(size, "Mesh/Size", true);
    }

    /// Of the level set at the nodes, of length 1, or 0 in the middle of what is thin.
    template <int dim>
    NodeVector<dim>
    normals(const Mesh<dim> &mesh, const NodeVector<dim> &gradient)
    {
      NodeVector<dim> result(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (const Tensor<1, dim> g = gradient.value(node); g.norm() > 0.1)
          result.set(node, g / g.norm());
      result.update_ghost_values();
      return result;
    }

    /// The larger principal curvature (1/m) at the nodes of cut cells, -1 at others: of the gradient of
    /// the normals, mean over the cut cells around a node and then over the nodes of these, for on
    /// graded cells one mean is rough. Collective.
    template <int dim>
    Vector
    largest_curvature(const Mesh<dim> &mesh, const NodeVector<dim> &normal, const Vector &phi)
    {
      std::vector<NodeVector<dim>> row;
      row.reserve(dim); // a vector of them that grows would lose their ghosts
      for (unsigned int d = 0; d < dim; ++d)
        row.emplace_back(mesh.nodes);
      const auto cut = [&](const LocalIndex c) { return is_cut(mesh, phi, c); };
      Tensor<2, dim> mean;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (mean_of_cells(
              mesh, node, cut, [&](const LocalIndex c) { return velocity_gradient(mesh, c, normal); }, mean))
          for (unsigned int d = 0; d < dim; ++d)
            row[d].set(node, mean[d]);
      for (NodeVector<dim> &r : row)
        r.update_ghost_values();
      const auto mean_of_nodes = [&](const LocalIndex c) {
        Tensor<2, dim> sum;
        for (const LocalIndex node : mesh.cell_nodes[c])
          for (unsigned int d = 0; d < dim; ++d)
            sum[d] += row[d].value(node) / (dim + 1);
        return sum;
      };
      Vector result = mesh.zeros(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          result.local_element(node) = -1;
          if (!mean_of_cells(mesh, node, cut, mean_of_nodes, mean))
            continue;
          const auto principal       = eigenvalues(symmetrize(mean));
          result.local_element(node) = std::max(std::abs(principal.front()), std::abs(principal.back()));
        }
      return result;
    }
  } // namespace

  template <int dim>
  Sizing<dim>::Sizing(const OctreeParameters<dim> &parameters, const Scene<dim> &scene)
    : prm(parameters)
    , scene(scene)
    , largest(formula<dim>(parameters.size))
  {}

  template <int dim>
  Vector
  Sizing<dim>::by_curvature(const Mesh<dim> &mesh, const NodeVector<dim> &normal, const Vector &phi) const
  {
    const Vector curvature = largest_curvature(mesh, normal, phi);
    const double coarsest  = prm.size_of(prm.coarsest_at_surface());
    Vector       size      = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (const double k = curvature.local_element(node); k >= 0)
        size.local_element(node) =
          std::max(prm.size_of(prm.level_asked()), coarsest / std::max(1., prm.leaves_per_radius * k * coarsest));
    return size;
  }

  template <int dim>
  Vector
  Sizing<dim>::at_surface(const State<dim> &state, const SurfaceGeometry<dim> &surface) const
  {
    const Mesh<dim> &mesh = *state.mesh;
    if (is_uniform_at_surface())
      {
        Vector none = mesh.zeros(mesh.nodes);
        none.update_ghost_values();
        return none;
      }
    const NodeVector<dim>   normal = normals(mesh, surface.level_set.gradients());
    Vector                  size   = by_curvature(mesh, normal, state.phi);
    std::vector<LocalIndex> nodes;
    std::string             error;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (double &s = size.local_element(node); s > 0)
        {
          nodes.push_back(node);
          if (largest)
            keep_error(error, [&] {
              s = std::min(s, size_by_formula(mesh.node_position[node], state.time));
              s = std::max(s, prm.size_of(prm.level_asked()));
            });
        }
    throw_first(mesh.communicator(), error);
    if (prm.leaves_across > 0)
      bound_by_thickness(state, surface, normal, nodes, size);
    size.update_ghost_values();
    return size;
  }

  template <int dim>
  void
  Sizing<dim>::bound_by_thickness(const State<dim>              &state,
                                  const SurfaceGeometry<dim>    &surface,
                                  const NodeVector<dim>         &normal,
                                  const std::vector<LocalIndex> &nodes,
                                  Vector                        &size) const
  {
    // a point below the surface and one above it for each level that may be too coarse
    const Mesh<dim>        &mesh = *state.mesh;
    std::vector<Point<dim>> points;
    const auto              depth = [&](const unsigned int level) {
      return prm.leaves_across * prm.size_of(level) / (1 + least_depth);
    };
    for (const LocalIndex node : nodes)
      for (unsigned int level = prm.coarsest_at_surface(); level < prm.surface_level; ++level)
        for (const double side : {-1., 1.})
          points.push_back(mesh.node_position[node] +
                           (side * depth(level) - state.phi.local_element(node)) * normal.value(node));
    const std::vector<Point<dim>> inside = mesh.locator().clamped(points);
    Guesses                       none;
    const std::vector<double>     phi     = surface.level_set.values(inside, none);
    const auto                    is_near = [&](const unsigned int k, const double phi, const double s) {
      const double deep = (1 - least_depth) * s; // beyond a wall
      return scene.solid_distance(points[k], state.time) < -deep ||
             points[k].distance(inside[k]) > deep || phi < least_depth * s;
    };
    std::string error;
    keep_error(error, [&] {
      for (unsigned int i = 0, k = 0; i < nodes.size(); ++i)
        for (unsigned int level = prm.coarsest_at_surface(); level < prm.surface_level; ++level, k += 2)
          if (is_near(k, -phi[k], depth(level)) || is_near(k + 1, phi[k + 1], depth(level)))
            size.local_element(nodes[i]) =
              std::min(size.local_element(nodes[i]), prm.size_of(level + 1));
    });
    throw_first(mesh.communicator(), error);
  }

  template <int dim>
  double
  Sizing<dim>::size_by_formula(const Point<dim> &x, const double time) const
  {
    const double size = (*largest)(x, time);
    if (!(size >= 0))
      value_error("Mesh/Size", size, "0 or more", x, time);
    return size;
  }

  template <int dim>
  unsigned int
  Sizing<dim>::level_in_liquid(const Point<dim> &x, const double distance, const double time) const
  {
    unsigned int level = std::max(prm.interior_level, scene.level_near(x, distance, time));
    if (largest)
      level = std::max(level, prm.level_of(size_by_formula(x, time)));
    return std::min(level, prm.surface_level);
  }

  template <int dim>
  bool
  Sizing<dim>::asks_in_liquid(const double time) const
  {
    return largest || may_jump(time) || scene.asks_for_levels();
  }

  template <int dim>
  bool
  Sizing<dim>::may_jump(const double time) const
  {
    return prm.fine_at_jumps &&
           (scene.has_advected_material() ? time <= 0 : !scene.has_constant_viscosity());
  }

  template <int dim>
  bool
  Sizing<dim>::jumps_in(const Point<dim> &centre,
                        const double      edge,
                        const double      time,
                        const bool        while_growing) const
  {
    if (!may_jump(time))
      return false;
    const Material<dim> *there   = scene.has_advected_material() ? &scene.initial_material(centre) : nullptr;
    bool                 differs = false;
    double               least = std::numeric_limits<double>::max(), most = 0;
    const auto           take = [&](Point<dim> x) {
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::clamp(x[d], prm.lower_corner[d], prm.upper_corner[d]);
      const Material<dim> *here = there ? &scene.initial_material(x) : nullptr;
      const double         mu   = here ? here->viscosity(x, time) : scene.viscosity(x, time);
      if (here != there)
        differs = differs || mu != there->viscosity(x, time) || here->density(x, time) != there->density(x, time);
      least = std::min(least, mu);
      most  = std::max(most, mu);
    };
    take(centre);
    for (unsigned int vertex = 0; vertex < 1u << dim; ++vertex)
      {
        take(vertex_of_cube<dim>(centre, edge, vertex));
        if (!while_growing)
          continue;
        take(vertex_of_cube<dim>(centre, 2 * edge, vertex));
        const Point<dim> child = vertex_of_cube<dim>(centre, 0.5 * edge, vertex);
        take(child);
        for (unsigned int of_child = 0; of_child < 1u << dim; ++of_child)
          take(vertex_of_cube<dim>(child, 0.5 * edge, of_child));
      }
    return differs || most > least_jump * least;
  }

  template <int dim>
  std::vector<unsigned int>
  vertex_levels(const OctreeParameters<dim> &prm,
                const Surface<dim>          &surface,
                const Vector                &size,
                const double                 factor)
  {
    std::vector<unsigned int> levels;
    for (const auto &vertex : surface.vertices)
      levels.push_back(std::max(prm.coarsest_at_surface(),
                                prm.level_of(factor * std::min(size.local_element(vertex.a),
                                                               size.local_element(vertex.b)))));
    return levels;
  }

  template <int dim>
  bool
  is_too_fine(const Mesh<dim> &mesh, const Vector &size)
  {
    const OctreeParameters<dim> &prm = mesh.octree().parameters();
    Tensor<1, 2> count; // of nodes at the surface, and of those that it asks for
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (const double s = size.local_element(node); s > 0)
        {
          const double asked = prm.size_of(std::max(prm.level_of(too_small * s), prm.interior_level));
          count[0] += 1;
          count[1] += std::pow(std::min(1., surface_size_at_node(mesh, node) / asked), dim - 1);
        }
    count = Utilities::MPI::sum(count, mesh.communicator());
    return count[1] < 0.5 * count[0];
  }

#define INSTANTIATE(dim)                                                                   \
  template class Sizing<dim>;                                                              \
  template std::vector<unsigned int> vertex_levels(                                        \
    const OctreeParameters<dim> &, const Surface<dim> &, const Vector &, const double);    \
  template bool is_too_fine(const Mesh<dim> &, const Vector &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
