// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_checkpoint_h
#define treacle_io_checkpoint_h

#include <treacle/fields/state.h>
#include <treacle/io/checkpoint_info.h>

#include <deal.II/base/parameter_handler.h>

#include <map>

namespace treacle
{
  /// Saves a state in `checkpoint/` of the output directory, and makes it again
  /// on any number of ranks. Written beside the older one and renamed: a kill at
  /// any moment leaves one that can be loaded.
  template <int dim>
  class Checkpoint
  {
  public:
    struct Parameters
    {
      unsigned int interval = 10; ///< frames; 0: never

      void
      add_parameters(ParameterHandler &prm);
    };

    /// What a run must know beside the state to go on.
    struct Progress
    {
      unsigned int                  frame = 0; ///< the last one written
      std::map<std::string, double> scalars;   ///< names without '='
    };

    Checkpoint(const MPI_Comm    &comm,
               const Parameters  &parameters,
               const std::string &output_directory);

    bool
    is_due(const unsigned int frame) const
    {
      return interval > 0 && frame > 0 && frame % interval == 0;
    }

    /// Collective, as is all below; throws a UserError on all ranks.
    void
    write(const State<dim> &state, const Progress &progress) const;

    /// @p parameters as for the Octree of a run from the start; the box and the finest level
    /// must be those of the saved one.
    std::pair<State<dim>, Progress>
    load(const typename Octree<dim>::Parameters &parameters) const;

    /// On a mesh from a file, which must be that of the saved state.
    std::pair<State<dim>, Progress>
    load(std::shared_ptr<const Mesh<dim>> imported) const;

    /// A new run starts: what an older one left must not be resumed.
    void
    remove() const;

  private:
    /// The newest complete checkpoint, of this kind of mesh.
    std::pair<std::string, CheckpointInfo>
    find(const std::string &mesh_type) const;

    /// Put the fresh one in the place of the older one; what went wrong, or nothing.
    std::string
    replace() const;

    std::pair<State<dim>, Progress>
    load(std::shared_ptr<const Mesh<dim>> mesh,
         const std::string               &directory,
         const CheckpointInfo            &info) const;

    MPI_Comm     comm;
    unsigned int interval;
    std::string path; ///< of the directory; with .new and .old while one replaces another
  };
} // namespace treacle

#endif
