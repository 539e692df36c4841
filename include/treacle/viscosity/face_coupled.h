// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_face_coupled_h
#define treacle_viscosity_face_coupled_h

#include <treacle/viscosity/least_squares.h>
#include <treacle/viscosity/node_system.h>

namespace treacle
{
  /// The viscous step in the velocity of the liquid faces, `A = M_f - step H^T D H`
  /// (the paper's implicit coupling), never formed. H is weighted with M_f: without
  /// weights neighbouring faces of a smooth flow are accelerated differently, and the
  /// error does not fall with the mesh (doc/method.md). Face vectors live on the mesh's
  /// partitioner and are zero where a face is no unknown.
  template <int dim>
  class FaceCoupled
  {
  public:
    /// @p stiffness makes -step D. The system must outlive this object.
    FaceCoupled(const NodeSystem<dim>                     &system,
                const typename NodeSystem<dim>::Stiffness &stiffness);

    FaceCoupled(const FaceCoupled &) = delete;

    /// y = A u.
    void
    vmult(Vector &y, const Vector &u) const;

    /// M_f u, and what prescribed components contribute.
    Vector
    right_hand_side(const Vector &u) const;

    /// Inverse of the diagonal of A, without what D couples between the nodes of a face
    /// (with it the diagonal is at most dim times as large) and without the means at
    /// invalid nodes. 0 where a face is no unknown.
    Vector
    inverse_diagonal() const;

    /// M_f^-1, 0 where a face is no unknown.
    const Vector &
    inverse_mass() const
    {
      return inverse_mass_of_faces;
    }

    /// -step D, and what prescribed components contribute to the forces.
    const typename NodeSystem<dim>::Assembled &
    stiffness() const
    {
      return assembled;
    }

    const NodeSystem<dim>   &system;
    const LeastSquares<dim>  H;

  private:
    Vector                              mass;      ///< M_f
    Vector                              inverse_mass_of_faces;
    typename NodeSystem<dim>::Assembled assembled; ///< -step D
    mutable Vector                      v, force;  ///< scratch: unknowns of nodes
  };
} // namespace treacle

#endif
