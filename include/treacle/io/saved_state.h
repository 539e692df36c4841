// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_saved_state_h
#define treacle_io_saved_state_h

#include <treacle/fields/state.h>
#include <treacle/io/checkpoint_info.h>

namespace treacle
{
  /// Write each number of a state once, in an order that no partition changes, as files of a
  /// directory, and return the lines of the checkpoint's text file on it. Throws a UserError
  /// on all ranks. Collective, as is all below.
  template <int dim>
  std::string
  write_state(const State<dim> &state, const std::string &directory);

  /// The state on the mesh that it had, on any number of ranks.
  template <int dim>
  State<dim>
  read_state(std::shared_ptr<const Mesh<dim>> mesh,
             const std::string               &directory,
             const CheckpointInfo            &info);
} // namespace treacle

#endif
