// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/scattered.h>
#include <treacle/fields/carried_in_cell.h>
#include <treacle/fields/layers.h>
#include <treacle/fields/moved_points.h>
#include <treacle/surface/carried_material.h>

namespace treacle
{
  namespace
  {
    /// Material points in a cell about a jump.
    template <int dim>
    constexpr unsigned int points_per_cell = dim == 2 ? 6 : 4;
    /// Rings of cells about a jump that have points.
    constexpr unsigned int n_rings = 2;
    /// Difference that makes a jump, over all that there is.
    constexpr double part_of_spread = 0.25;

    /// Owned and ghost elements.
    void
    fill(Vector &v, const double value)
    {
      v.zero_out_ghost_values();
      const unsigned int n = v.locally_owned_size() + v.get_partitioner()->n_ghost_indices();
      for (unsigned int i = 0; i < n; ++i)
        v.local_element(i) = value;
    }

    /// One of the properties that make a material.
    template <int dim>
    struct Property
    {
      CarriedField &field;
      double MaterialPoint<dim>::*of_point;
      /// Largest less smallest value anywhere.
      double spread = 0;

      bool
      jumps(const double least, const double largest) const
      {
        return largest > least_jump * least ||
               largest - least > std::max(part_of_spread * spread, 1e-9 * largest); // more than roundoff
      }

      double
      in_cell(const CarriedInCell<dim> &cell, const VertexValues<dim> &lambda) const
      {
        return jumps(cell.least, cell.largest) ? cell.sharp(lambda) : cell.smooth(lambda);
      }
    };

    /// The material points of a state, and what they tell the nodes.
    template <int dim>
    class MaterialPoints
    {
    public:
      /// Points that left the liquid are dropped.
      MaterialPoints(State<dim> &state, const MeshData<dim> &data)
        : state(state)
        , data(data)
        , mesh(data.mesh)
        , material(*state.material)
        , solid_distance(data.solid_distance(state.time))
        , density{material.density, &MaterialPoint<dim>::density}
        , viscosity{material.viscosity, &MaterialPoint<dim>::viscosity}
        , weight(mesh.nodes)
        , count(mesh.cells)
      {
        locate();
        for (Property<dim> *property : {&density, &viscosity})
          {
            property->spread = spread_of(*property);
            give_to_nodes(*property);
            smooth(*property);
          }
      }

      /// Does a node know its material?
      bool
      is_known(const LocalIndex node) const
      {
        return state.phi.local_element(node) < 0 || weight.local_element(node) > 0;
      }

      /// What a point in a cell is made of.
      MaterialPoint<dim>
      point(const Point<dim> &x, const LocalIndex cell, const VertexValues<dim> &lambda) const
      {
        return {x,
                density.in_cell({mesh, density.field, cell}, lambda),
                viscosity.in_cell({mesh, viscosity.field, cell}, lambda)};
      }

      /// As many points as are wanted in the cells about jumps, and none elsewhere; @p make
      /// (position, cell, barycentric coordinates) gives new ones. Nodes learn of them next time.
      template <typename Make>
      void
      reseed(const Make &make)
      {
        const Vector is_wanted = cells_about_jumps();
        thin(is_wanted);
        std::vector<MaterialPoint<dim>> seeds;
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          {
            if (is_wanted.local_element(c) == 0)
              continue;
            const auto         places = places_in(c);
            const unsigned int n      = count.local_element(c);
            for (unsigned int k = n; 2 * n < places.size() && k < places.size(); ++k)
              {
                Point<dim> x;
                for (unsigned int i = 0; i <= dim; ++i)
                  x += places[k][i] * mesh.node_position[mesh.cell_nodes[c][i]];
                seeds.push_back(make(x, c, places[k]));
              }
          }
        seeds = to_owners(mesh, seeds); // a cell may be another rank's than its leaf
        material.points.insert(material.points.end(), seeds.begin(), seeds.end());
      }

    private:
      static double
      at(const VertexValues<dim> &values, const VertexValues<dim> &lambda)
      {
        return std::inner_product(values.begin(), values.end(), lambda.begin(), 0.);
      }

      void
      locate()
      {
        std::vector<MaterialPoint<dim>> kept;
        for (const MaterialPoint<dim> &point : material.points)
          {
            const Location<dim> found = mesh.locator().locate_here(point.position);
            if (found.cell == invalid)
              continue;
            const double reach = 0.5 * mesh.cell_size[found.cell];
            if (at(mesh.values(found.cell, state.phi), found.lambda) > reach ||
                at(mesh.values(found.cell, solid_distance), found.lambda) < -reach)
              continue;
            kept.push_back(point);
            place.push_back(found);
            count.local_element(found.cell) += 1;
            for (unsigned int i = 0; i <= dim; ++i)
              weight.local_element(mesh.cell_nodes[found.cell][i]) += found.lambda[i];
          }
        material.points = std::move(kept);
        for (Vector *v : {&count, &weight})
          {
            v->compress(VectorOperation::add);
            v->update_ghost_values();
          }
      }

      double
      spread_of(const Property<dim> &property) const
      {
        double     least = std::numeric_limits<double>::max(), largest = -least;
        const auto take = [&](const double value) {
          least   = std::min(least, value);
          largest = std::max(largest, value);
        };
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          if (state.phi.local_element(node) < 0)
            take(property.field.mean.local_element(node));
        for (const MaterialPoint<dim> &point : material.points)
          take(point.*property.of_point);
        const MPI_Comm comm = mesh.communicator();
        return Utilities::MPI::max(largest, comm) - Utilities::MPI::min(least, comm);
      }

      /// About a jump nodes take the mean of the points in their cells, with P1 weights; elsewhere
      /// they keep what they have, within bounds that the points set.
      void
      give_to_nodes(const Property<dim> &property)
      {
        CarriedField &field = property.field;
        Vector        sum(mesh.nodes);
        fill(field.least, std::numeric_limits<double>::max());
        fill(field.largest, -std::numeric_limits<double>::max());
        for (unsigned int k = 0; k < place.size(); ++k)
          for (unsigned int i = 0; i <= dim; ++i)
            {
              const LocalIndex node  = mesh.cell_nodes[place[k].cell][i];
              const double     value = material.points[k].*property.of_point;
              double &least = field.least.local_element(node), &largest = field.largest.local_element(node);
              sum.local_element(node) += place[k].lambda[i] * value;
              least   = std::min(least, value);
              largest = std::max(largest, value);
            }
        sum.compress(VectorOperation::add);
        field.least.compress(VectorOperation::min);
        field.largest.compress(VectorOperation::max);
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            const double w    = weight.local_element(node);
            double      &mean = field.mean.local_element(node);
            double &least = field.least.local_element(node), &largest = field.largest.local_element(node);
            if (w > 0 && property.jumps(least, largest))
              {
                mean = sum.local_element(node) / w;
                continue;
              }
            // points on one side of a node do not see all that is about
            if (w > 0)
              mean = std::min(std::max(mean, 1.5 * least - 0.5 * largest), 1.5 * largest - 0.5 * least);
            least = largest = mean;
          }
        field.update_ghost_values();
      }

      /// About jumps a mean over neighbours as well: where the middle is must not depend on how the points
      /// happen to lie, for cells of either kind strewn among those of the other are hard to solve for.
      void
      smooth(const Property<dim> &property)
      {
        const CarriedField before = property.field;
        before.update_ghost_values();
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            double &least   = property.field.least.local_element(node);
            double &largest = property.field.largest.local_element(node);
            for (const auto &neighbour : data.neighbours(node))
              if (is_known(neighbour.node))
                {
                  least   = std::min(least, before.least.local_element(neighbour.node));
                  largest = std::max(largest, before.largest.local_element(neighbour.node));
                }
            if (property.jumps(least, largest))
              mean_of_neighbours(
                data,
                node,
                [&](const LocalIndex other) { return is_known(other); },
                [&](const LocalIndex other) { return before.mean.local_element(other); },
                property.field.mean.local_element(node));
            else
              least = largest = property.field.mean.local_element(node);
          }
        property.field.update_ghost_values();
      }

      /// 1 for these, also ghosts.
      Vector
      cells_about_jumps() const
      {
        Vector is_wanted(mesh.cells), is_near(mesh.nodes);
        is_near.update_ghost_values();
        for (unsigned int ring = 0; ring <= n_rings; ++ring)
          {
            for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
              if (is_wanted.local_element(c) == 0)
                is_wanted.local_element(c) =
                  ring == 0 ? has_jump(c) :
                              std::any_of(mesh.cell_nodes[c].begin(),
                                          mesh.cell_nodes[c].end(),
                                          [&](const auto node) { return is_near.local_element(node) > 0; });
            is_near.zero_out_ghost_values();
            for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
              if (is_wanted.local_element(c) > 0)
                for (const LocalIndex node : mesh.cell_nodes[c])
                  is_near.local_element(node) = 1;
            is_near.compress(VectorOperation::max);
            is_near.update_ghost_values();
          }
        is_wanted.update_ghost_values();
        return is_wanted;
      }

      bool
      has_jump(const LocalIndex c) const
      {
        for (const Property<dim> *property : {&density, &viscosity})
          {
            double least = std::numeric_limits<double>::max(), largest = -least;
            for (const LocalIndex node : mesh.cell_nodes[c])
              if (is_known(node))
                {
                  least   = std::min(least, property->field.least.local_element(node));
                  largest = std::max(largest, property->field.largest.local_element(node));
                }
            if (largest >= least && property->jumps(least, largest))
              return true;
          }
        return false;
      }

      /// Crowded cells keep a part of their points that depends on their places alone.
      void
      thin(const Vector &is_wanted)
      {
        std::vector<MaterialPoint<dim>> kept;
        for (unsigned int k = 0; k < place.size(); ++k)
          {
            const LocalIndex c = place[k].cell;
            const double     n = count.local_element(c), target = points_per_cell<dim>;
            if (is_wanted.local_element(c) > 0 &&
                (n <= 2 * target + 2 ||
                 scattered_at(material.points[k].position, 1e-3 * mesh.cell_size[c]) * n < target))
              kept.push_back(material.points[k]);
          }
        material.points = std::move(kept);
      }

      /// Where points are sown in the liquid of a cell.
      std::vector<VertexValues<dim>>
      places_in(const LocalIndex c) const
      {
        std::uint64_t key = 0;
        for (const LocalIndex node : mesh.cell_nodes[c])
          key += mesh.node_key[node];
        const VertexValues<dim>        phi = mesh.values(c, state.phi), solid = mesh.values(c, solid_distance);
        std::vector<VertexValues<dim>> places;
        for (unsigned int k = 0; k < points_per_cell<dim>; ++k)
          {
            auto cut = even_point<dim>(scattered(key), k);
            std::sort(cut.begin(), cut.end()); // cuts of the unit interval are even in a simplex
            VertexValues<dim> lambda;
            for (unsigned int i = 0; i <= dim; ++i)
              lambda[i] = (i < dim ? cut[i] : 1.) - (i > 0 ? cut[i - 1] : 0.);
            if (at(phi, lambda) < 0 && at(solid, lambda) > 0)
              places.push_back(lambda);
          }
        return places;
      }

      State<dim>                &state;
      const MeshData<dim>       &data;
      const Mesh<dim>           &mesh;
      CarriedMaterial<dim>      &material;
      const std::vector<double> &solid_distance;
      Property<dim>              density, viscosity;
      std::vector<Location<dim>> place;  ///< of the points
      Vector                     weight; ///< of the points around each node
      Vector                     count;  ///< of points in each cell
    };
  } // namespace

  template <int dim>
  void
  set_initial_material(State<dim> &state, const MeshData<dim> &data)
  {
    const Mesh<dim>  &mesh  = data.mesh;
    const Scene<dim> &scene = data.scene;
    state.material.emplace(mesh.nodes);
    std::string error;
    const auto  point = [&](const Point<dim> &x) {
      MaterialPoint<dim> result{x, 1, 0};
      keep_error(error, [&] {
        const Material<dim> &material = scene.initial_material(x);
        result                        = {x, material.density(x, 0.), material.viscosity(x, 0.)};
      });
      return result;
    };
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (state.phi.local_element(node) < 0)
        {
          const auto [x, density, viscosity]                  = point(mesh.node_position[node]);
          state.material->density.mean.local_element(node)   = density;
          state.material->viscosity.mean.local_element(node) = viscosity;
        }
    throw_first(mesh.communicator(), error);
    MaterialPoints<dim>(state, data).reseed(
      [&](const Point<dim> &x, LocalIndex, const VertexValues<dim> &) { return point(x); });
    throw_first(mesh.communicator(), error);
  }

  template <int dim>
  void
  settle_material(State<dim> &state, const MeshData<dim> &data, const unsigned int n_layers)
  {
    const Mesh<dim>    &mesh = data.mesh;
    MaterialPoints<dim> points(state, data);
    Vector              known(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      known.local_element(node) = points.is_known(node);
    CarriedField &density = state.material->density, &viscosity = state.material->viscosity;
    continue_outwards(
      data,
      known,
      n_layers,
      [&](const LocalIndex node) {
        return Tensor<1, 2>({density.mean.local_element(node), viscosity.mean.local_element(node)});
      },
      [&](const LocalIndex node, const Tensor<1, 2> &value) {
        density.set(node, value[0]);
        viscosity.set(node, value[1]);
      },
      [&] { state.material->update_ghost_values(); });
    // cells at the surface have nodes in the air
    points.reseed([&](const auto &...where) { return points.point(where...); });
  }

  template void
  set_initial_material(State<2> &, const MeshData<2> &);
  template void
  set_initial_material(State<3> &, const MeshData<3> &);
  template void
  settle_material(State<2> &, const MeshData<2> &, const unsigned int);
  template void
  settle_material(State<3> &, const MeshData<3> &, const unsigned int);
} // namespace treacle
