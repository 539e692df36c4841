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

    /// u of a state that has its phi, and no velocity yet: what the backward difference starts from. Collective.
    void
    advance(State<dim> &state) const;

  private:
    /// The velocity of now and of the step before, and that of the way between.
    struct Past
    {
      CarriedFields<dim> now, before;
      NodeVector<dim>    between;
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

      /// The first n.
      void
      drop(const unsigned int n)
      {
        from.erase(from.begin(), from.begin() + n);
        cells.erase(cells.begin(), cells.begin() + n);
        values.erase(values.begin(), values.begin() + n * dim);
      }
    };

    Paths
    paths_to(PathEnds<dim> &&ends, const std::vector<NodeField<dim>> &now) const;

    /// By how much the velocity changed in the step before along these paths, from what it was @p before, in place of the values.
    std::vector<double>
    change_along(Paths &&paths, const Past &past, const std::vector<NodeField<dim>> &before) const;

    /// The velocity of now where nodes come from, and by how much it changed in the step before along their paths.
    struct AtNodes
    {
      NodeVector<dim> now, change;
    };

    /// At the nodes of some faces; no change without a past. The mean of the change is smoother than what is read at the faces, which
    /// feeds short waves of a surface without viscosity; deep in the liquid it feeds vortices. In the air, of which faces count
    /// only that markers are about to find in the liquid, all that is known is that of its nodes.
    AtNodes
    at_nodes(const CarriedFields<dim>      &now,
             const Past                    *past,
             const Mesh<dim>               &mesh,
             const std::vector<LocalIndex> &faces) const;

    const State<dim>        &old;
    const LiquidDomain<dim> &domain;
    const BackwardDifference difference;
    const StepVelocity<dim> &velocity; ///< at nodes
    const Carry              carry;
  };
} // namespace treacle

#endif
