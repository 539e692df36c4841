// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/forest.h>

namespace treacle
{
  template <int dim>
  Forest<dim>::Forest(const MPI_Comm &comm, const TreeOrder<dim> &order, const int root_size)
    : order(order)
    , root_size(root_size)
    , connectivity(connect(order))
    , forest(Functions::new_forest(comm, connectivity.get(), 0, 0, 1, sizeof(int), nullptr, nullptr),
             [](typename Types::forest *f) { Functions::destroy(f); })
  {}

  template <int dim>
  std::unique_ptr<typename Forest<dim>::Connectivity, void (*)(typename Forest<dim>::Connectivity *)>
  Forest<dim>::connect(const TreeOrder<dim> &order)
  {
    constexpr unsigned int n_corners = 1 << dim, n_faces = 2 * dim;
    LatticePoint<dim>      n_along;
    unsigned int           n_vertices = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_vertices *= n_along[d] = order.n[d] + 1;
    Connectivity *c;
    if constexpr (dim == 2)
      c = Functions::connectivity_new(n_vertices, order.n_trees(), 0, 0);
    else
      c = Functions::connectivity_new(n_vertices, order.n_trees(), 0, 0, 0, 0);
    for (unsigned int i = 0; i < n_vertices; ++i)
      for (unsigned int d = 0, rest = i; d < 3; rest /= d < dim ? n_along[d] : 1, ++d)
        c->vertices[3 * i + d] = d < dim ? rest % n_along[d] : 0.;
    for (unsigned int tree = 0; tree < order.n_trees(); ++tree)
      {
        for (unsigned int corner = 0; corner < n_corners; ++corner)
          {
            unsigned int vertex = 0;
            for (int d = dim - 1; d >= 0; --d)
              vertex = vertex * n_along[d] + order.root(tree)[d] + ((corner >> axis_on_curve<dim>(d)) & 1);
            c->tree_to_vertex[n_corners * tree + corner] = vertex;
          }
        for (unsigned int face = 0; face < n_faces; ++face)
          {
            c->tree_to_tree[n_faces * tree + face] = tree;
            c->tree_to_face[n_faces * tree + face] = face;
          }
      }
    if constexpr (dim == 2)
      p4est_connectivity_complete(c);
    else
      p8est_connectivity_complete(c);
    return {c, [](Connectivity *old) { Functions::connectivity_destroy(old); }};
  }

  template <int dim>
  Leaf<dim>
  Forest<dim>::leaf_of(const unsigned int tree, const Quadrant &quadrant) const
  {
    const int                                      unit  = (1 << Functions::max_level) / root_size;
    const unsigned int                             level = quadrant.level;
    std::array<typename Types::quadrant_coord, dim> place{{quadrant.x, quadrant.y}};
    if constexpr (dim == 3)
      place[2] = quadrant.z;
    Leaf<dim> leaf{{}, root_size >> level, level};
    for (unsigned int d = 0; d < dim; ++d)
      leaf.origin[d] = order.root(tree)[d] * root_size + place[axis_on_curve<dim>(d)] / unit;
    return leaf;
  }

  template <int dim>
  void
  Forest<dim>::for_each_quadrant(const std::function<void(unsigned int, Quadrant &)> &action) const
  {
    for (auto tree = forest->first_local_tree; tree <= forest->last_local_tree; ++tree)
      {
        sc_array_t &quadrants = static_cast<typename Types::tree *>(sc_array_index(forest->trees, tree))->quadrants;
        for (std::size_t i = 0; i < quadrants.elem_count; ++i)
          action(tree, *static_cast<Quadrant *>(sc_array_index(&quadrants, i)));
      }
  }

  template <int dim>
  std::vector<Leaf<dim>>
  Forest<dim>::owned_leaves() const
  {
    std::vector<Leaf<dim>> leaves;
    leaves.reserve(forest->local_num_quadrants);
    for_each_quadrant([&](const unsigned int tree, const Quadrant &quadrant) {
      leaves.push_back(leaf_of(tree, quadrant));
    });
    return leaves;
  }

  template <int dim>
  std::vector<unsigned int>
  Forest<dim>::weights() const
  {
    std::vector<unsigned int> result;
    result.reserve(forest->local_num_quadrants);
    for_each_quadrant([&](unsigned int, Quadrant &quadrant) { result.push_back(number(quadrant)); });
    return result;
  }

  template <int dim>
  std::vector<Leaf<dim>>
  Forest<dim>::ghost_leaves() const
  {
    const std::unique_ptr<typename Types::ghost, void (*)(typename Types::ghost *)> layer(
      Functions::ghost_new(forest.get(), over_corners),
      [](typename Types::ghost *g) { Functions::ghost_destroy(g); });
    std::vector<Leaf<dim>> leaves;
    for (std::size_t i = 0; i < layer->ghosts.elem_count; ++i)
      {
        const auto &quadrant = *static_cast<Quadrant *>(sc_array_index(&layer->ghosts, i));
        leaves.push_back(leaf_of(quadrant.p.piggy3.which_tree, quadrant));
      }
    return leaves;
  }

  template <int dim>
  void
  Forest<dim>::set_numbers(const std::function<int(unsigned int)> &of_leaf)
  {
    unsigned int i = 0;
    for_each_quadrant([&](unsigned int, Quadrant &quadrant) { number(quadrant) = of_leaf(i++); });
  }

  template <int dim>
  bool
  Forest<dim>::refine(const std::vector<bool> &is_to_refine)
  {
    const auto clear = [](typename Types::forest *, typename Types::topidx, Quadrant *quadrant) {
      number(*quadrant) = 0;
    };
    const auto before = forest->global_num_quadrants;
    set_numbers([&](const unsigned int i) { return is_to_refine[i] ? 1 : 0; });
    Functions::refine(forest.get(), 0, number_of, clear);
    if (forest->global_num_quadrants == before)
      return false;
    Functions::balance(forest.get(), over_corners, clear);
    Functions::partition(forest.get(), 1, nullptr);
    return true;
  }

  template <int dim>
  void
  Forest<dim>::partition(const std::vector<unsigned int> &weight)
  {
    set_numbers([&](const unsigned int i) { return static_cast<int>(weight[i]); });
    Functions::partition(forest.get(), 1, number_of);
  }

  template class Forest<2>;
  template class Forest<3>;
} // namespace treacle
