// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_scene_h
#define treacle_scene_scene_h

#include <treacle/scene/emitter.h>
#include <treacle/scene/solid.h>

namespace treacle
{
  /// What the parameter file says of the world: box, walls, liquids, solids,
  /// emitters, material, gravity. Positions in m, time in s, no state of its own.
  template <int dim>
  class Scene
  {
  public:
    struct Parameters
    {
      struct Liquid
      {
        typename Shape<dim>::Parameters    shape;
        std::string                        velocity = (dim == 2 ? "0; 0" : "0; 0; 0"); // m/s
        typename Material<dim>::Parameters material;
      };

      Point<dim>  lower_corner;
      Point<dim>  upper_corner   = diagonal_point<dim>(1);
      std::string wall_condition = "no slip";
      std::string transport      = "fixed";
      std::string acceleration   = (dim == 2 ? "0; -9.81" : "0; 0; -9.81"); // m/s^2

      typename Material<dim>::Parameters material{"1000", "150"};

      std::vector<Liquid>                            liquids;
      std::vector<typename Solid<dim>::Parameters>   solids;
      std::vector<typename Emitter<dim>::Parameters> emitters;

      /// Declare the subsections, with Liquid 1 to n_liquids and so on; @p prm
      /// writes into this object when it parses.
      void
      add_parameters(ParameterHandler  &prm,
                     const unsigned int n_liquids,
                     const unsigned int n_solids,
                     const unsigned int n_emitters = 0);
    };

    /// Throws a UserError on all ranks that names the parameter at fault. Collective, for the
    /// first rank reads files.
    explicit Scene(const Parameters &parameters, const MPI_Comm &comm = MPI_COMM_SELF);

    const Point<dim> &
    lower_corner() const;
    const Point<dim> &
    upper_corner() const;

    /// Does the liquid stick to this kind of wall? Sides of the box are 2 axis +
    /// (upper ? 1 : 0); all others, see Walls, have the default condition.
    bool
    no_slip(const unsigned int wall) const;

    unsigned int n_liquids() const;

    /// Signed distance to liquid k (from 0) at t = 0, negative inside.
    double liquid_distance(const unsigned int k, const Point<dim> &x) const;

    /// Signed distance to the liquid at t = 0, negative inside: the union of the
    /// liquids and of the emitters that start then. A large number without any.
    double
    liquid_distance(const Point<dim> &x) const;

    /// Velocity at t = 0: of the emitter around x, or of the nearest liquid.
    Tensor<1, dim>
    initial_velocity(const Point<dim> &x) const;

    /// Material at t = 0: of the emitter around x, or of the nearest liquid.
    const Material<dim> &
    initial_material(const Point<dim> &x) const;

    bool
    has_solids() const;

    unsigned int
    n_solids() const;

    /// Signed distance to the union of the solids, positive outside
    /// them (where liquid may be); a large number if there is none.
    double
    solid_distance(const Point<dim> &x, const double t) const;

    /// Of the nearest solid (m/s).
    Tensor<1, dim>
    solid_velocity(const Point<dim> &x, const double t) const;

    /// The solid (from 0) of smallest distance; there is at least one.
    unsigned int
    nearest_solid(const Point<dim> &x, const double t) const;

    /// Centre of rotation of solid k (m).
    Point<dim>
    solid_centre(const unsigned int k, const double t) const;

    /// Throws a UserError if a moving solid has left the box, or its motion is not finite:
    /// for all ranks together, before some of them ask where solids are at t.
    void
    check_solids(const double t) const;

    const std::vector<Emitter<dim>> &
    emitters() const;

    /// Signed distance to the union of the emitters at work from t on, negative
    /// inside; a large number if there is none.
    double
    emitter_distance(const Point<dim> &x, const double t) const;

    /// Of the nearest emitter at work from t on (m/s); zero if there is none.
    Tensor<1, dim>
    emitter_velocity(const Point<dim> &x, const double t) const;

    /// Smallest distance to the boundary of an emitter that has not stopped at t.
    double
    distance_to_emitter_boundary(const Point<dim> &x, const double t) const;

    /// The next time after t at which an emitter starts or stops (s).
    double
    next_switch(const double t) const;

    /// Does an emitter start or stop at t?
    bool
    has_switch_at(const double t) const;

    /// Are density and viscosity carried along with the liquid?
    bool
    has_advected_material() const;

    double
    density(const Point<dim> &x, const double t) const; // kg/m^dim
    double
    viscosity(const Point<dim> &x, const double t) const; // Pa s
    Tensor<1, dim>
    gravity(const Point<dim> &x, const double t) const; // m/s^2

  private:
    struct Liquid
    {
      Shape<dim>            shape;
      VectorExpression<dim> velocity;
      Material<dim>         material;
    };

    /// The emitter at work from t on with the smallest distance, or null, and that distance.
    std::pair<const Emitter<dim> *, double>
    nearest_emitter(const Point<dim> &x, const double t) const;

    void
    check_transport(const Parameters &parameters) const;

    Point<dim>                lower, upper;
    std::array<bool, 2 * dim + 1> sticks; // per side of the box; the default
    Material<dim>             material;
    bool                      advected_material;
    VectorExpression<dim>     gravity_at;
    std::vector<Liquid>       liquids;
    std::vector<Solid<dim>>   solids;
    std::vector<Emitter<dim>> emitter_list;
  };
} // namespace treacle

#endif
