// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/moved_points.h>
#include <treacle/geometry/cut_simplex.h>
#include <treacle/surface/emission.h>

namespace treacle
{
  namespace
  {
    /// How far a point is beyond the box or in a solid (m), negative in the open.
    template <int dim>
    double
    depth_beyond(const Point<dim> &x, const Scene<dim> &scene, const double time)
    {
      double depth = -scene.solid_distance(x, time);
      for (unsigned int d = 0; d < dim; ++d)
        depth = std::max({depth, scene.lower_corner()[d] - x[d], x[d] - scene.upper_corner()[d]});
      return depth;
    }

    template <int dim>
    Point<dim>
    in_box(Point<dim> x, const Scene<dim> &scene)
    {
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::min(std::max(x[d], scene.lower_corner()[d]), scene.upper_corner()[d]);
      return x;
    }

    template <int dim>
    void
    set_material(State<dim> &state, const Scene<dim> &scene, const double time)
    {
      const Mesh<dim>      &mesh     = *state.mesh;
      CarriedMaterial<dim> &material = *state.material;
      std::string           error;
      const auto            set = [&](const Point<dim> &x, double &density, double &viscosity) {
        for (const Emitter<dim> &emitter : scene.emitters())
          if (emitter.is_at_work(time) && emitter.signed_distance(x) <= 0)
            keep_error(error, [&] {
              density   = emitter.material.density(x, time);
              viscosity = emitter.material.viscosity(x, time);
            });
      };
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        set(mesh.node_position[node],
            material.density.mean.local_element(node),
            material.viscosity.mean.local_element(node));
      for (MaterialPoint<dim> &point : material.points)
        set(point.position, point.density, point.viscosity);
      throw_first(mesh.communicator(), error);
      material.update_ghost_values();
    }
  } // namespace

  namespace
  {
    /// How emitters change phi in a step, which is old at a point once what was there has moved.
    template <int dim>
    class Filling
    {
    public:
      /// Full a time of @p dt before were the emitters that worked @p earlier; h is the finest leaf.
      Filling(const Scene<dim> &scene, const double h, const double time, const double earlier, const double dt)
        : scene(scene)
        , h(h)
        , time(time)
        , earlier(earlier)
        , dt(dt)
      {}

      struct Phi
      {
        double after;
        double inside; ///< emitters
        double kept;   ///< inside, what came from there or was there already
      };

      /// Paths that lead back through a wall bring none: what sticks to the ceiling beside an emitter, as a skin
      /// of it, must not become a second one.
      Phi
      phi(const Point<dim> &x, const double old) const
      {
        const double distance = scene.emitter_distance(x, time);
        if (distance >= 2 * h) // what flowed in is no other than what was there
          return {std::min(old, distance), distance, distance};
        const Point<dim> from  = x - dt * scene.emitter_velocity(x, time);
        const double     depth = depth_beyond(from, scene, time);
        // what flowed on from there has sharp edges here; what phi shows of it bulges beside them for their volume
        constexpr double bulge  = 0.1; // leaves
        const double     before = std::max(std::min(old + bulge * h, scene.emitter_distance(from, earlier)), depth);
        const bool       is_skin =
          depth > 0 && old > -h && scene.emitter_distance(in_box(from, scene), time) > 0;
        return {std::min(is_skin ? std::max(old, depth) : old, distance),
                distance,
                std::max(distance, before)};
      }

    private:
      const Scene<dim> &scene;
      const double      h, time, earlier, dt;
    };

    /// What an emitter adds in a simplex. In a step it may be much thinner than a leaf, which functions that are linear between nodes show
    /// 20 to 50 % too thick or too thin at edges and corners of the emitter: so the simplex is halved where they matter, as often as asked.
    template <int dim>
    class EmittedVolume
    {
    public:
      explicit EmittedVolume(const Filling<dim> &filling)
        : filling(filling)
      {}

      struct Vertex
      {
        Point<dim>                  x;
        double                      old; ///< phi
        double                      psi; ///< distance to solids
        typename Filling<dim>::Phi  phi;
      };
      using Vertices = std::array<Vertex, dim + 1>;

      Vertex
      vertex(const Point<dim> &x, const double old, const double psi) const
      {
        return {x, old, psi, filling.phi(x, old)};
      }

      /// (m^dim)
      double
      operator()(const Vertices &v, const unsigned int halvings) const
      {
        std::array<unsigned int, 2> edge{};
        double                      longest = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (const double length = v[i].x.distance(v[j].x); length > longest)
              {
                longest = length;
                edge    = {{i, j}};
              }
        const auto is_far = [&](const Vertex &a) {
          return std::min(std::abs(a.phi.inside), std::abs(a.phi.kept)) > longest;
        };
        if (halvings == 0 || std::all_of(v.begin(), v.end(), is_far))
          return volume(v, &Filling<dim>::Phi::inside) - volume(v, &Filling<dim>::Phi::kept);
        const auto  &[i, j] = edge;
        const Vertex middle = vertex(v[i].x + 0.5 * (v[j].x - v[i].x),
                                     0.5 * (v[i].old + v[j].old),
                                     0.5 * (v[i].psi + v[j].psi));
        double       sum    = 0;
        for (const unsigned int k : edge)
          {
            Vertices half = v;
            half[k]       = middle;
            sum += (*this)(half, halvings - 1);
          }
        return sum;
      }

    private:
      static double
      volume(const Vertices &v, double Filling<dim>::Phi::*phi)
      {
        Simplex<dim>      x;
        VertexValues<dim> values, psi;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            x[i]      = v[i].x;
            values[i] = v[i].phi.*phi;
            psi[i]    = v[i].psi;
          }
        return liquid_moments<dim>(x, values, psi).volume;
      }

      const Filling<dim> &filling;
    };

    /// Cuts the liquid in emitters and beside them out of state.phi, and puts the emitters
    /// in. Returns the volume that flowed in (m^dim). Collective.
    template <int dim>
    double
    fill_emitters(State<dim> &state, const MeshData<dim> &data, const Filling<dim> &filling)
    {
      constexpr unsigned int halvings = 2 * dim; // of each edge about two
      const Mesh<dim>           &mesh = *state.mesh;
      const std::vector<double> &psi  = data.solid_distance(state.time);
      std::string                error;
      std::vector<typename EmittedVolume<dim>::Vertex> vertices(mesh.node_position.size());
      const EmittedVolume<dim>                         emitted(filling);
      Vector                                           filled(mesh.nodes);
      for (LocalIndex node = 0; node < vertices.size(); ++node)
        keep_error(error, [&] {
          vertices[node] =
            emitted.vertex(mesh.node_position[node], state.phi.local_element(node), psi[node]);
          if (node < mesh.n_owned_nodes())
            filled.local_element(node) = vertices[node].phi.after;
        });
      throw_first(mesh.communicator(), error);
      double volume = 0;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        if (const auto &nodes = mesh.cell_nodes[c];
            std::any_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) {
              return vertices[node].phi.inside != vertices[node].phi.kept;
            }))
          {
            typename EmittedVolume<dim>::Vertices v;
            std::transform(nodes.begin(), nodes.end(), v.begin(), [&](const LocalIndex node) {
              return vertices[node];
            });
            keep_error(error, [&] { volume += emitted(v, halvings); });
          }
      throw_first(mesh.communicator(), error);
      filled.update_ghost_values();
      state.phi = filled;
      state.phi.update_ghost_values();
      return Utilities::MPI::sum(volume, mesh.communicator());
    }

    /// Emitters that have poured for a time @p dt until @p time take the markers inside away, for the liquid that these bounded has come
    /// in from behind. Along its sides and its back the stream is bounded by the emitter itself, and markers lie there: of those that are
    /// about there only those outside would be left, and make it wider on its way (one of two leaves' radius by 5 % of its volume).
    template <int dim>
    void
    settle_markers(State<dim> &state, const Scene<dim> &scene, const double h, const double time, const double dt)
    {
      constexpr double    inside = 0.1, about = 0.25, across = 0.02; // leaves
      constexpr double    alike = 0.5;                               // cosine of normals
      const Distance<dim> distance = [&](const Point<dim> &x) { return scene.emitter_distance(x, time); };
      const auto          is_behind = [&](const Marker<dim> &marker, const Marker<dim> &on) {
        if (!(on.normal * marker.normal > alike))
          return false;
        const double ahead = dt * scene.emitter_velocity(on.position, time) * on.normal;
        return ahead < across * h && on.position.distance(marker.position) < about * h + std::max(0., -ahead);
      };
      std::vector<Marker<dim>> kept, on_emitter;
      const auto               settle = [&](const Marker<dim> &marker) {
        const double depth = -distance(marker.position);
        if (depth > -about * h)
          if (const auto on = marker_on(distance, marker.position, 1e-3 * h); is_behind(marker, on))
            return on_emitter.push_back(on);
        if (depth <= inside * h)
          kept.push_back(marker);
      };
      std::string error;
      keep_error(error, [&] { std::for_each(state.markers.begin(), state.markers.end(), settle); });
      throw_first(state.mesh->communicator(), error);
      clamp(*state.mesh, on_emitter);
      kept.insert(kept.end(), on_emitter.begin(), on_emitter.end());
      state.markers = std::move(kept);
    }
  } // namespace

  template <int dim>
  double
  emit(State<dim> &state, const MeshData<dim> &data, const double dt)
  {
    // steps end where emitters start and stop
    const Scene<dim> &scene = data.scene;
    const double      h = data.mesh.finest_size(), end = state.time, start = std::max(0., end - dt),
                 middle    = 0.5 * (start + end);
    double       volume    = 0;
    const auto   fill_with = [&](const double time, const double earlier, const double way) {
      volume += fill_emitters(state, data, Filling<dim>(scene, h, time, earlier, way));
      if (state.material)
        set_material(state, scene, time);
      settle_markers(state, scene, h, time, way);
    };
    const auto any = [&](const auto &is) {
      return std::any_of(scene.emitters().begin(), scene.emitters().end(), is);
    };
    if (any([&](const Emitter<dim> &emitter) { return emitter.is_at_work(middle); }))
      fill_with(middle, start, dt);
    // at once, as at t = 0 those that start there
    if (any([&](const Emitter<dim> &emitter) {
          return emitter.is_at_work(end) && !emitter.is_at_work(middle);
        }))
      fill_with(end, middle, 0);
    return volume;
  }

  template double
  emit(State<2> &, const MeshData<2> &, const double);
  template double
  emit(State<3> &, const MeshData<3> &, const double);
} // namespace treacle
