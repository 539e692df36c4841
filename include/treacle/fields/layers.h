// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_layers_h
#define treacle_fields_layers_h

#include <treacle/fields/mesh_data.h>

namespace treacle
{
  /// Carry values on from the nodes where @p is_known is positive: layer by layer, the nodes
  /// around them take the mean over their known neighbours. @p value (node) gives one,
  /// @p set (node, value) takes it at owned nodes, @p update is called for the ghosts
  /// after each layer. is_known grows. Collective.
  template <int dim, typename Value, typename Set, typename Update>
  void
  continue_outwards(const MeshData<dim> &data,
                    Vector              &is_known,
                    const unsigned int   n_layers,
                    const Value         &value,
                    const Set           &set,
                    const Update        &update)
  {
    using Mean          = std::decay_t<decltype(value(LocalIndex()))>;
    const auto is_value = [&](const LocalIndex node) { return is_known.local_element(node) > 0; };
    std::vector<LocalIndex> unknown;
    for (LocalIndex node = 0; node < data.mesh.n_owned_nodes(); ++node)
      if (!is_value(node))
        unknown.push_back(node);
    is_known.update_ghost_values();
    update();
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        std::vector<std::pair<LocalIndex, Mean>> found;
        Mean                                     mean;
        for (const LocalIndex node : unknown)
          if (mean_of_neighbours(data, node, is_value, value, mean))
            found.emplace_back(node, mean);
        for (const auto &[node, result] : found)
          {
            is_known.local_element(node) = 1;
            set(node, result);
          }
        unknown.erase(std::remove_if(unknown.begin(), unknown.end(), is_value), unknown.end());
        is_known.update_ghost_values();
        update();
      }
  }
} // namespace treacle

#endif
