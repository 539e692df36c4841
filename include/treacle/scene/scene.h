// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_scene_h
#define treacle_scene_scene_h

#include <treacle/scene/emitters.h>
#include <treacle/scene/solids.h>
#include <treacle/scene/wall_condition.h>

namespace treacle
{
  /// What the parameter file says of the world: box, walls, liquids, solids,
  /// emitters, material, gravity. Positions in m, time in s, no state of its own. What
  /// concerns solids or emitters alone it has from them.
  template <int dim>
  class Scene : public Solids<dim>, public Emitters<dim>
  {
  public:
    struct Parameters
    {
      struct Liquid
      {
        typename Shape<dim>::Parameters shape;
        std::string                     velocity = (dim == 2 ? "0; 0" : "0; 0; 0"); // m/s
        typename Material<dim>::Parameters material;

        /// Declare in the current subsection.
        void
        add_parameters(ParameterHandler &prm);
      };

      Point<dim>        lower_corner;
      Point<dim>        upper_corner   = diagonal_point<dim>(1);
      std::string       wall_condition = "no slip";
      unsigned int      wall_level     = 0; ///< of leaves with liquid along walls that hold it
      MaterialTransport transport      = MaterialTransport::fixed;
      std::string       acceleration   = (dim == 2 ? "0; -9.81" : "0; 0; -9.81"); // m/s^2

      typename Material<dim>::Parameters material{"1000", "150"};

      std::vector<Liquid>                liquids;
      typename Solids<dim>::Parameters   solids;
      typename Emitters<dim>::Parameters emitters;

      /// Declare the subsections, with Liquid 1 to n_liquids and so on; @p prm
      /// writes into this object when it parses.
      void
      add_parameters(ParameterHandler  &prm,
                     const unsigned int n_liquids,
                     const unsigned int n_solids,
                     const unsigned int n_emitters = 0);

    private:
      void
      add_domain(ParameterHandler &prm);

      void
      add_material_and_gravity(ParameterHandler &prm);
    };

    /// Throws a UserError on all ranks that names the parameter at fault. Collective, for the
    /// first rank reads files.
    explicit Scene(const Parameters &parameters, const MPI_Comm &comm = MPI_COMM_SELF);

    const Point<dim> &
    lower_corner() const;
    const Point<dim> &
    upper_corner() const;

    BoundingBox<dim>
    box() const
    {
      return BoundingBox<dim>({lower, upper});
    }

    /// How far (m) rounding may take points and distances, which are 0 where they are less.
    double
    rounding() const
    {
      return least_distance;
    }

    /// Does the liquid stick to this kind of wall? Sides of the box are 2 axis +
    /// (upper ? 1 : 0); all others, see Walls, have the default condition.
    bool
    no_slip(const unsigned int wall) const;

    /// The largest level that is asked for by solids and sides of the box closer than @p distance
    /// (m); 0: none.
    unsigned int
    level_near(const Point<dim> &x, const double distance, const double t) const;

    /// Is any asked for?
    bool
    asks_for_levels() const;

    unsigned int
    n_liquids() const
    {
      return liquids.size();
    }

    /// A number with the sign of the distance to liquid k (from 0) at t = 0, negative inside.
    double
    side_of_liquid(const unsigned int k, const Point<dim> &x) const;

    /// Signed distance to the liquid at t = 0, negative inside: the union of the
    /// liquids and of the emitters that start then. A large number without any.
    double
    liquid_distance(const Point<dim> &x) const;

    /// The same to the liquids alone.
    double
    distance_to_liquids(const Point<dim> &x) const;

    /// Velocity at t = 0: of the emitter around x, or of the last liquid around it, or else of the nearest.
    Tensor<1, dim>
    initial_velocity(const Point<dim> &x) const;

    /// Material at t = 0, of the same.
    const Material<dim> &
    initial_material(const Point<dim> &x) const;

    /// Is an emitter at work nearer than the solids are?
    bool
    is_emitter_nearest(const Point<dim> &x, const double t) const;

    /// Sooner known than a distance.
    bool
    is_in_solids(const Point<dim> &x, const double t) const
    {
      return this->solid_distance_within(x, rounding(), t) < 0;
    }

    /// Are density and viscosity carried along with the liquid?
    bool
    has_advected_material() const;

    double
    density(const Point<dim> &x, const double t) const; // kg/m^dim
    double
    viscosity(const Point<dim> &x, const double t) const; // Pa s

    /// The same everywhere, at all times?
    bool
    has_constant_viscosity() const
    {
      return material.viscosity_is_constant();
    }
    Tensor<1, dim>
    gravity(const Point<dim> &x, const double t) const; // m/s^2

    /// By solids that move, or by gravity or emitters that change?
    bool
    is_driven() const
    {
      const auto &emitters = this->emitters();
      return this->has_moving_solids() || gravity_at.depends_on_time() ||
             std::any_of(emitters.begin(), emitters.end(), [](const auto &e) { return e.changes_velocity(); });
    }

  private:
    struct Liquid
    {
      Shape<dim>            shape;
      VectorExpression<dim> velocity;
      Material<dim>         material;
    };

    void
    check_transport(const Parameters &parameters) const;

    /// Of one at least, with its distance (m).
    std::pair<const Liquid *, double>
    nearest_liquid(const Point<dim> &x) const;

    /// The last of those around x; outside of all the nearest.
    const Liquid &
    liquid_at(const Point<dim> &x) const;

    Point<dim>            lower, upper;
    double                least_distance; // m
    WallConditions<dim>   walls;
    unsigned int          wall_level;
    Material<dim>         material;
    MaterialTransport     transport;
    VectorExpression<dim> gravity_at;
    std::vector<Liquid>   liquids;
  };
} // namespace treacle

#endif
