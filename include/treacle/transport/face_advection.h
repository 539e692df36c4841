// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_face_advection_h
#define treacle_transport_face_advection_h

#include <treacle/fields/backward_difference.h>
#include <treacle/fields/liquid_domain.h>
#include <treacle/transport/carried_fields.h>
#include <treacle/transport/free_fall.h>
#include <treacle/transport/path_ends.h>
#include <treacle/transport/velocity_in_time.h>

#include <functional>

namespace treacle
{
  /// Carries the velocity along to the faces that may carry liquid.
  template <int dim>
  class FaceAdvection
  {
  public:
    /// How a scheme carries fields on for a time (s).
    using Carry =
      std::function<CarriedFields<dim>(std::vector<NodeField<dim>> &&, const VelocityInStep<dim> &, const double)>;

    /// From the old state by the step of a backward difference. All must outlive this object.
    FaceAdvection(const State<dim>         &old,
                  const LiquidDomain<dim>  &domain,
                  const BackwardDifference &difference,
                  const StepVelocity<dim>  &velocity,
                  const Carry              &carry);

    /// u of a state that has its phi, and no velocity yet: what the backward difference starts from. If it @p remembers for the next one,
    /// the old velocity where the liquid at its nodes comes from; NaN where that is not known. Collective.
    NodeVector<dim>
    advance(State<dim> &state, const bool remembers) const;

  private:
    /// The velocity of now and of the step before.
    struct Past
    {
      CarriedFields<dim> now, before;
      NodeVector<dim>    change;  ///< since then along the paths to nodes that know it
      Vector             knows;   ///< 1 at these, else 0
      NodeVector<dim>    between; ///< of the way between
      FreeFall<dim>      fall;
    };

    /// Of a state that has a velocity before.
    Past
    past(CarriedFields<dim> &&now) const;

    /// The paths of a step: where they come from, the cells there, and the velocity of now there
    /// ([path * dim + component]).
    struct Paths
    {
      std::vector<Point<dim>> from;
      Guesses                 cells;
      std::vector<double>     values;

      Paths
      part(const unsigned int begin, const unsigned int end) const
      {
        return {{from.begin() + begin, from.begin() + end},
                {cells.begin() + begin, cells.begin() + end},
                {values.begin() + begin * dim, values.begin() + end * dim}};
      }
    };

    Paths
    paths_to(PathEnds<dim> &&ends, const std::vector<NodeField<dim>> &now) const;

    /// By how much the velocity changed in the step before along these paths: what all nodes about know of it, else from where a path
    /// that goes on comes from.
    std::vector<double>
    change_along(const Paths &paths, const Past &past) const;

    /// Nodes, and the paths to them.
    struct ToNodes
    {
      std::vector<LocalIndex> nodes;
      Paths                   paths;
      unsigned int            n_first = 0; ///< of the faces that were asked for first
    };

    /// Those of some faces, then those of others alone. Near the surface the mean of the change at nodes is smoother than what is
    /// read at the faces, which feeds short waves of a surface without viscosity. In the air, of which faces count
    /// only that markers are about to find in the liquid, all that is known is that of its nodes.
    ToNodes
    to_nodes(const CarriedFields<dim>      &now,
             const Mesh<dim>               &mesh,
             const std::vector<LocalIndex> &first,
             const std::vector<LocalIndex> &then) const;

    /// At those of the nodes that are below the skin of a state the velocity of now where their liquid comes from, @p bent between nodes; NaN
    /// elsewhere.
    NodeVector<dim>
    known_along(const State<dim> &state, const ToNodes &to, const std::vector<NodeField<dim>> &bent) const;

    const State<dim>        &old;
    const LiquidDomain<dim> &domain;
    const BackwardDifference difference;
    const StepVelocity<dim> &velocity; ///< at nodes
    const Carry              carry;
  };
} // namespace treacle

#endif
