// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/viscosity_jumps.h>
#include <treacle/geometry/cut_simplex.h>

namespace treacle
{
  namespace
  {
    /// Of the mean: layers that slide on one another ask for -1, but a velocity that is linear across
    /// the jump makes them too stiff. Measured: doc/method.md.
    constexpr double exponent = -2;

    /// Barycentric coordinates of points spread evenly in a cell.
    template <int dim>
    std::vector<VertexValues<dim>>
    even_points()
    {
      constexpr unsigned int         n       = dim == 2 ? 12 : 6;
      const unsigned int             n_boxes = dim == 2 ? n * n : n * n * n;
      std::vector<VertexValues<dim>> result;
      for (unsigned int k = 0; k < n_boxes; ++k)
        {
          const std::array<unsigned int, 3> digit{{k % n, k / n % n, k / (n * n)}};
          VertexValues<dim>                 lambda;
          lambda[dim] = 1;
          for (unsigned int i = 0; i < dim; ++i)
            {
              lambda[i] = (digit[i] + 1. / (dim + 1)) / n;
              lambda[dim] -= lambda[i];
            }
          if (lambda[dim] > 0)
            result.push_back(lambda);
        }
      return result;
    }

    /// The mean over a cell's liquid of @p viscosity (barycentric coordinates); @p otherwise if none
    /// is found.
    template <int dim, typename Viscosity>
    double
    mean_of_liquid(const State<dim>          &state,
                   const std::vector<double> &solid_distance,
                   const LocalIndex           c,
                   const double               otherwise,
                   const Viscosity           &viscosity)
    {
      static const std::vector<VertexValues<dim>> even = even_points<dim>();

      const VertexValues<dim> phi   = state.mesh->values(c, state.phi);
      const VertexValues<dim> solid = state.mesh->values(c, solid_distance);
      double                  sum   = 0;
      unsigned int            n     = 0;
      for (const VertexValues<dim> &lambda : even)
        {
          if (interpolate(phi, lambda) >= 0 || interpolate(solid, lambda) <= 0)
            continue;
          sum += std::pow(viscosity(lambda), exponent);
          ++n;
        }
      return n > 0 ? std::pow(sum / n, 1 / exponent) : otherwise;
    }

    template <int dim>
    class FormulaInCells
    {
    public:
      FormulaInCells(const Scene<dim> &scene, const State<dim> &state)
        : scene(scene)
        , mesh(*state.mesh)
        , time(state.time)
        , at_node(mesh.node_position.size(), unknown)
      {}

      bool
      jumps(const LocalIndex c)
      {
        double least = std::numeric_limits<double>::max(), most = 0;
        for (const LocalIndex node : mesh.cell_nodes[c])
          {
            double &value = at_node[node];
            if (value == unknown)
              value = scene.viscosity(mesh.node_position[node], time);
            least = std::min(least, value);
            most  = std::max(most, value);
          }
        return most > least_jump * least;
      }

      /// Where jumps() has been asked.
      std::optional<ViscosityJump<dim>>
      jump(const LocalIndex c) const
      {
        return find_jump<dim>(mesh.cell_vertices(c), mesh.values(c, at_node), [this](const Point<dim> &x) {
          return scene.viscosity(x, time);
        });
      }

      double
      value(const LocalIndex c, const VertexValues<dim> &lambda) const
      {
        Point<dim> point;
        for (unsigned int i = 0; i <= dim; ++i)
          point += lambda[i] * mesh.node_position[mesh.cell_nodes[c][i]];
        return scene.viscosity(point, time);
      }

    private:
      static constexpr double unknown = -1;

      const Scene<dim>   &scene;
      const Mesh<dim>    &mesh;
      const double        time;
      std::vector<double> at_node;
    };

    /// How much of a cell's liquid there is on the sides of a jump; false if there is none.
    template <int dim>
    bool
    measure_parts(const State<dim> &state, const LocalIndex c, ViscosityJump<dim> &jump)
    {
      const Simplex<dim>      x   = state.mesh->cell_vertices(c);
      const VertexValues<dim> phi = state.mesh->values(c, state.phi);
      VertexValues<dim>       other_way;
      std::transform(jump.distance.begin(), jump.distance.end(), other_way.begin(), std::negate<>());
      jump.part        = {{liquid_moments<dim>(x, phi, other_way).volume, liquid_moments<dim>(x, phi, jump.distance).volume}};
      const double all = jump.part[0] + jump.part[1];
      for (double &part : jump.part)
        part /= all;
      return all > 0;
    }
  } // namespace

  template <int dim>
  std::map<LocalIndex, ViscosityJump<dim>>
  soften_jumps(const Scene<dim>          &scene,
               const State<dim>          &state,
               const std::vector<double> &solid_distance,
               const CutCells<dim>       &cut_cells,
               const std::vector<double> &liquid_volume,
               std::vector<double>       &viscosity)
  {
    std::map<LocalIndex, ViscosityJump<dim>> jumps;
    if (!state.material && scene.has_constant_viscosity())
      return jumps;
    const Mesh<dim> &mesh   = *state.mesh;
    const auto       soften = [&](const LocalIndex c, const auto &value, const auto &find) {
      viscosity[c] = mean_of_liquid(state, solid_distance, c, viscosity[c], value);
      if (cut_cells.parts(c).size() == 0)
        if (auto jump = find(); jump && measure_parts(state, c, *jump))
          jumps.emplace(c, *jump);
    };
    const auto for_each_cell = [&](const auto &visit) {
      for (LocalIndex c = 0; c < viscosity.size(); ++c)
        if (liquid_volume[c] > 0)
          visit(c);
    };
    if (state.material)
      {
        const CarriedField     &field = state.material->viscosity;
        const CarriedJumps<dim> find(mesh, field, liquid_volume);
        for_each_cell([&](const LocalIndex c) {
          const CarriedInCell<dim> carried(mesh, field, c);
          if (carried.jumps())
            soften(c, [&](const auto &lambda) { return carried.value(lambda); }, [&] { return find(c, carried.values()); });
        });
        return jumps;
      }
    std::string         error;
    FormulaInCells<dim> formula(scene, state);
    for_each_cell([&](const LocalIndex c) {
      keep_error(error, [&] {
        if (formula.jumps(c))
          soften(c, [&](const auto &lambda) { return formula.value(c, lambda); }, [&] { return formula.jump(c); });
      });
    });
    throw_first(mesh.communicator(), error);
    return jumps;
  }

  template std::map<LocalIndex, ViscosityJump<2>>
  soften_jumps(const Scene<2> &,
               const State<2> &,
               const std::vector<double> &,
               const CutCells<2> &,
               const std::vector<double> &,
               std::vector<double> &);
  template std::map<LocalIndex, ViscosityJump<3>>
  soften_jumps(const Scene<3> &,
               const State<3> &,
               const std::vector<double> &,
               const CutCells<3> &,
               const std::vector<double> &,
               std::vector<double> &);
} // namespace treacle
