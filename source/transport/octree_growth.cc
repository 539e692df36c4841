// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/transport/bent_walls.h>
#include <treacle/transport/octree_growth.h>

namespace treacle
{
  namespace
  {
    /// What leaves cost with phi at their centres, in microseconds of a step: the liquid, and more
    /// where the surface cuts it, the air little.
    template <int dim>
    std::vector<unsigned int>
    costs(const OctreeParameters<dim>  &prm,
          const std::vector<Leaf<dim>> &leaves,
          const std::vector<double>    &phi)
    {
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < leaves.size(); ++i)
        result.push_back((phi[i] < 0 ? 14 : 3) + (is_within(prm, leaves[i], phi[i], 0.) ? 10 : 0));
      return result;
    }

    /// The next larger leaves that Maximum cells is met with.
    constexpr double coarser = 1.25;

    /// Which power of that a factor is.
    int
    power_of(const double factor)
    {
      return std::lround(std::log(factor) / std::log(coarser));
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const Octree<dim>>
  OctreeGrowth<dim>::grow(const typename Octree<dim>::Criterion &is_near, const double size_factor) const
  {
    return std::make_shared<const Octree<dim>>(
      comm,
      prm,
      [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<bool> refine = is_near(leaves);
        // ranks without leaves of this level do not know it
        const unsigned int level =
          Utilities::MPI::max(leaves.empty() ? 0u : leaves.front().level, comm);
        if (level < prm.air_level)
          return std::vector<bool>(leaves.size(), true);
        if (level < prm.interior_level || may_be_too_coarse())
          refine_liquid(leaves, level, refine);
        return refine;
      },
      [&](const std::vector<Leaf<dim>> &leaves) {
        return costs<dim>(prm, leaves, phi_at_centres(leaves));
      },
      size_factor);
  }

  template <int dim>
  bool
  OctreeGrowth<dim>::is_full(const Octree<dim> &octree) const
  {
    return prm.maximum_cells > 0 && prm.n_cells(n_leaves(octree)) > prm.maximum_cells;
  }

  template <int dim>
  std::shared_ptr<const Octree<dim>>
  OctreeGrowth<dim>::grow_around(const Octree<dim> &octree, const PointsByFactor &points) const
  {
    const auto with = [&](const double factor) {
      const Bands<dim> bands(octree, scene, time, points(factor), false);
      return grow([&](const std::vector<Leaf<dim>> &leaves) { return bands.touch(leaves); }, factor);
    };
    if (prm.maximum_cells == 0)
      return with(1);
    // from where it was in growing strides, until it lies between two, then by bisection: no memory may hold the finest
    const int largest = power_of(largest_factor());
    int       least = 0, most = largest + 1, power = std::min(power_of(octree.size_factor()), largest);
    std::shared_ptr<const Octree<dim>> result;
    for (int stride = 1; least < most; stride *= 2)
      {
        auto tried = with(std::pow(coarser, power));
        if (is_full(*tried) && power < largest)
          least = power + 1;
        else
          {
            most   = power;
            result = std::move(tried);
          }
        power = !result    ? std::min(power + stride, largest) :
                least == 0 ? std::max(power - stride, 0) :
                             (least + most) / 2;
      }
    return result;
  }

  template <int dim>
  double
  OctreeGrowth<dim>::largest_factor() const
  {
    const double largest = prm.size_of(prm.coarsest_at_surface()) / prm.size_of(prm.level_asked());
    return prm.maximum_cells == 0 ? 1. : std::pow(coarser, std::ceil(std::log(largest) / std::log(coarser)));
  }

  template <int dim>
  bool
  OctreeGrowth<dim>::is_any_too_coarse(const std::vector<Leaf<dim>> &leaves) const
  {
    const std::vector<bool> coarse = are_too_coarse(leaves, false);
    const bool              here   = std::find(coarse.begin(), coarse.end(), true) != coarse.end();
    return Utilities::MPI::max(here ? 1 : 0, comm) > 0;
  }

  template <int dim>
  std::vector<double>
  OctreeGrowth<dim>::phi_at_centres(const std::vector<Leaf<dim>> &leaves) const
  {
    std::vector<VertexKey>  unknown;
    std::vector<Point<dim>> x;
    for (const Leaf<dim> &leaf : leaves)
      if (const VertexKey key = pack<dim>(leaf.centre()); known_phi.count(key) == 0)
        {
          unknown.push_back(key);
          x.push_back(centre<dim>(prm, leaf));
        }
    const std::vector<double> found = phi(x);
    for (unsigned int i = 0; i < unknown.size(); ++i)
      known_phi[unknown[i]] = found[i];
    std::vector<double> result;
    for (const Leaf<dim> &leaf : leaves)
      result.push_back(known_phi.at(pack<dim>(leaf.centre())));
    return result;
  }

  template <int dim>
  bool
  OctreeGrowth<dim>::is_too_coarse(const Leaf<dim> &leaf, const bool while_growing) const
  {
    const double     edge   = prm.size_of(leaf.level);
    const double     reach  = half_diagonal<dim>(edge) + (while_growing ? 0.5 * edge : 0.);
    const Point<dim> x      = centre<dim>(prm, leaf);
    bool             result = sizing.level_in_liquid(x, reach, time) > leaf.level ||
                  (leaf.level < prm.surface_level && sizing.jumps_in(x, edge, time, while_growing));
    for (unsigned int child = 0; child < 1u << dim && while_growing && !result; ++child)
      result = sizing.level_in_liquid(vertex_of_cube<dim>(x, 0.5 * edge, child), 0, time) > leaf.level;
    return result;
  }

  template <int dim>
  bool
  OctreeGrowth<dim>::do_walls_bend(const Leaf<dim> &leaf, const bool while_growing) const
  {
    return leaf.level < prm.coarsest_at_surface() &&
           walls_bend_in(scene,
                         centre<dim>(prm, leaf),
                         prm.size_of(leaf.level),
                         prm.size_of(prm.coarsest_at_surface()),
                         time,
                         while_growing);
  }

  template <int dim>
  std::vector<bool>
  OctreeGrowth<dim>::are_too_coarse(const std::vector<Leaf<dim>> &leaves,
                                    const bool                    while_growing) const
  {
    const bool                is_asked = sizing.asks_in_liquid(time);
    std::vector<bool>         result(leaves.size(), false);
    std::vector<Leaf<dim>>    asked;
    std::vector<unsigned int> place;
    for (unsigned int i = 0; i < leaves.size(); ++i)
      if ((result[i] = do_walls_bend(leaves[i], while_growing)) || is_asked)
        {
          asked.push_back(leaves[i]);
          place.push_back(i);
        }
    // phi is a distance near the surface only; around it bands make leaves fine
    const double              known = 2 * prm.size_of(prm.coarsest_at_surface());
    const std::vector<double> phi   = phi_at_centres(asked);
    std::string               error;
    keep_error(error, [&] {
      for (unsigned int k = 0; k < asked.size(); ++k)
        result[place[k]] = phi[k] < std::min(known, half_diagonal<dim>(prm.size_of(asked[k].level))) &&
                           (result[place[k]] || is_too_coarse(asked[k], while_growing));
    });
    throw_first(comm, error);
    return result;
  }

  template <int dim>
  void
  OctreeGrowth<dim>::refine_liquid(const std::vector<Leaf<dim>> &leaves, const unsigned int level, std::vector<bool> &refine) const
  {
    if (may_be_too_coarse())
      {
        const std::vector<bool> asked = are_too_coarse(leaves, true);
        std::transform(refine.begin(), refine.end(), asked.begin(), refine.begin(), std::logical_or<>());
      }
    if (level >= prm.interior_level)
      return;
    const std::vector<double> values = phi_at_centres(leaves);
    for (unsigned int i = 0; i < leaves.size(); ++i)
      refine[i] = refine[i] || values[i] < 0;
  }

  template class OctreeGrowth<2>;
  template class OctreeGrowth<3>;
} // namespace treacle
