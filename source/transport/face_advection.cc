// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/surface_size.h>
#include <treacle/transport/face_advection.h>
#include <treacle/transport/face_residual.h>
#include <treacle/transport/velocity_curvature.h>

namespace treacle
{
  namespace
  {
    /// How far below the surface the change along paths is found at nodes, in leaves.
    constexpr double deep_leaves = 4;

    /// How far from the surface faces of the air begin, which few markers will find in the liquid, in leaves.
    constexpr double outside_leaves = 0.25;

    /// How far below the surface nodes begin that know what their liquid had a step before, in leaves: no multiple of a half, where nodes lie
    /// below a surface along leaves. Nearer to it the velocity that paths come from is continued into the air, or flattened by the fit, and
    /// what liquid has there now is not.
    constexpr double skin_leaves = 1.9;

    /// Values at owned nodes ([node * dim + component]). Collective.
    template <int dim>
    void
    set_values(NodeVector<dim> &v, const std::vector<LocalIndex> &nodes, const std::vector<double> &values)
    {
      for (unsigned int i = 0; i < values.size(); ++i)
        v.component[i % dim].local_element(nodes[i / dim]) = values[i];
      v.update_ghost_values();
    }

    /// Faces that take what is known of them in different ways; those of nodes come first.
    template <int dim>
    class FaceGroups
    {
    public:
      std::vector<LocalIndex>                 all;
      std::vector<LocalIndex>::const_iterator liquid; ///< before them those of the air
      std::vector<LocalIndex>::const_iterator deep;   ///< before them those whose nodes are all in the liquid, but not deep

      explicit FaceGroups(const State<dim> &state)
        : all(faces_that_matter(state))
      {
        const double h   = state.mesh->surface_size();
        const auto   air = bring_forward(state, all.begin(), outside_leaves * h, std::numeric_limits<double>::max());
        liquid           = air;
        deep             = bring_forward(state, air, -deep_leaves * h, 0);
      }

      FaceGroups(const FaceGroups &) = delete;

    private:
      /// Those whose nodes are all so far from the surface; the end of them.
      std::vector<LocalIndex>::iterator
      bring_forward(const State<dim>                       &state,
                    const std::vector<LocalIndex>::iterator begin,
                    const double                            lowest,
                    const double                            highest)
      {
        return std::stable_partition(begin, all.end(), [&](const LocalIndex f) {
          const auto &nodes = state.mesh->face_nodes[f];
          return std::all_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) {
            return state.phi.local_element(node) > lowest && state.phi.local_element(node) <= highest;
          });
        });
      }
    };
  } // namespace

  template <int dim>
  FaceAdvection<dim>::FaceAdvection(const State<dim>         &old,
                                    const LiquidDomain<dim>  &domain,
                                    const BackwardDifference &difference,
                                    const StepVelocity<dim>  &velocity,
                                    const Carry              &carry)
    : old(old)
    , domain(domain)
    , difference(difference)
    , velocity(velocity)
    , carry(carry)
  {}

  template <int dim>
  typename FaceAdvection<dim>::Past
  FaceAdvection<dim>::past(CarriedFields<dim> &&now) const
  {
    const VelocityBefore<dim> &before = *old.before;
    NodeVector<dim>            change(old.mesh->nodes);
    Vector                     knows(old.mesh->nodes);
    for (LocalIndex node = 0; node < old.mesh->n_owned_nodes(); ++node)
      if (before.remembers(node))
        {
          change.set(node, old.v.value(node) - before.v_along->value(node));
          knows.local_element(node) = 1;
        }
    change.update_ghost_values();
    knows.update_ghost_values();
    return {std::move(now),
            carry(fields_of(*before.v), velocity.carried[2], difference.dt + before.dt),
            std::move(change),
            std::move(knows),
            combined(0.5, old.v, 0.5, *before.v),
            {old, domain}};
  }

  template <int dim>
  typename FaceAdvection<dim>::Paths
  FaceAdvection<dim>::paths_to(PathEnds<dim> &&ends, const std::vector<NodeField<dim>> &now) const
  {
    const Tracer<dim> tracer(*old.mesh);
    Paths             paths{tracer.trace(ends.x, velocity.carried, -difference.dt, ends.cells, ends.velocity), {}, {}};
    paths.values = tracer.evaluate(paths.from, now, ends.cells);
    paths.cells  = std::move(ends.cells);
    return paths;
  }

  template <int dim>
  std::vector<double>
  FaceAdvection<dim>::change_along(const Paths &paths, const Past &past) const
  {
    constexpr double            rounding = 1e-6; // of the part that is known: what lies beside nodes that know is of no other cell
    const Tracer<dim>           tracer(*old.mesh);
    Guesses                     cells = paths.cells, there;
    std::vector<NodeField<dim>> fields = fields_of(past.change);
    fields.push_back({&past.knows});
    const std::vector<double> known = tracer.evaluate(paths.from, fields, cells);
    std::vector<unsigned int> unknown;
    std::vector<Point<dim>>   from;
    std::vector<double>       change;
    for (unsigned int i = 0; i < paths.from.size(); ++i)
      {
        const double *of_point = &known[i * (dim + 1)];
        change.insert(change.end(), of_point, of_point + dim);
        if (of_point[dim] > 1 - rounding)
          continue;
        unknown.push_back(i);
        from.push_back(paths.from[i]);
        there.push_back(cells[i]);
      }
    const std::vector<double> now     = tracer.evaluate(from, past.now.fields, there);
    const auto                further = tracer.trace(from, past.between, -old.before->dt, there);
    const std::vector<double> before  = tracer.evaluate(further, past.before.fields, there);
    for (unsigned int i = 0; i < unknown.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        change[dim * unknown[i] + d] = now[dim * i + d] - before[dim * i + d];
    past.fall.set_change(change, paths.from, cells, old.before->dt);
    return change;
  }

  template <int dim>
  typename FaceAdvection<dim>::ToNodes
  FaceAdvection<dim>::to_nodes(const CarriedFields<dim>      &now,
                               const Mesh<dim>               &mesh,
                               const std::vector<LocalIndex> &first,
                               const std::vector<LocalIndex> &then) const
  {
    constexpr double is_asked = 1, is_asked_first = 2;
    Vector           asked    = mesh.zeros(mesh.nodes);
    const auto       ask      = [&](const std::vector<LocalIndex> &faces, const double how) {
      for (const LocalIndex f : faces)
        for (const LocalIndex node : mesh.face_nodes[f])
          asked.local_element(node) = how;
    };
    ask(then, is_asked);
    ask(first, is_asked_first);
    asked.compress(VectorOperation::max);
    ToNodes       to;
    PathEnds<dim> ends(mesh, *old.mesh, velocity.carried[4]);
    const auto    add = [&](const double how) {
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (asked.local_element(node) == how)
          {
            to.nodes.push_back(node);
            ends.add_node(node);
          }
    };
    add(is_asked_first);
    to.n_first = to.nodes.size();
    add(is_asked);
    to.paths = paths_to(std::move(ends), now.fields);
    return to;
  }

  template <int dim>
  NodeVector<dim>
  FaceAdvection<dim>::known_along(const State<dim> &state, const ToNodes &to, const std::vector<NodeField<dim>> &bent) const
  {
    NodeVector<dim>         along(state.mesh->nodes, std::numeric_limits<double>::quiet_NaN());
    std::vector<LocalIndex> nodes;
    std::vector<Point<dim>> from;
    Guesses                 cells;
    for (unsigned int i = 0; i < to.nodes.size(); ++i)
      if (const LocalIndex node = to.nodes[i]; state.phi.local_element(node) < -skin_leaves * surface_size_at_node(*state.mesh, node))
        {
          nodes.push_back(node);
          from.push_back(to.paths.from[i]);
          cells.push_back(to.paths.cells[i]);
        }
    set_values(along, nodes, Tracer<dim>(*old.mesh).evaluate(from, bent, cells));
    return along;
  }

  template <int dim>
  NodeVector<dim>
  FaceAdvection<dim>::advance(State<dim> &state, const bool remembers) const
  {
    const Mesh<dim>      &mesh    = *state.mesh;
    const bool            is_same = &mesh == old.mesh.get();
    const FaceGroups<dim> faces(state);
    PathEnds<dim>         ends(mesh, *old.mesh, velocity.carried[4]);
    std::for_each(faces.liquid, faces.all.end(), [&](const LocalIndex f) { ends.add_face(f); });
    const auto add = [&](const auto begin, const double weight, const std::vector<double> &values) {
      for (unsigned int i = 0; i < values.size(); ++i)
        state.u.local_element(begin[i / dim]) += weight * mesh.face_normal[begin[i / dim]][i % dim] * values[i];
    };
    CarriedFields<dim> now = carry(fields_of(old.v), velocity.carried, difference.dt);
    // a scheme's corrections do the same
    const Vector                      bends = now.corrections.empty() ? bending_nodes(domain, difference.dt) : Vector();
    const VelocityCurvature<dim>      curvature(*old.mesh, old.v, bends);
    const std::vector<NodeField<dim>> bent = curvature.bent(now.fields);
    const Paths paths = paths_to(std::move(ends), is_same ? bent : now.fields); // faces of another mesh have no nodes here
    add(faces.liquid, 1, paths.values);
    if (is_same)
      std::for_each(faces.liquid, faces.all.end(), [&](const LocalIndex f) {
        state.u.local_element(f) -= mesh.face_normal[f] * curvature.at_face(f);
      });
    keep_what_nodes_miss(old, domain, difference, mesh, faces.all, state.u);
    const ToNodes to =
      to_nodes(now, mesh, {faces.all.cbegin(), faces.deep}, {faces.deep, remembers ? faces.all.cend() : faces.deep});
    const auto add_of_nodes = [&](const auto end, const double weight, const std::vector<double> &values) {
      NodeVector<dim> v(mesh.nodes);
      set_values(v, to.nodes, values);
      std::for_each(faces.all.begin(), end, [&](const LocalIndex f) {
        state.u.local_element(f) += weight * face_velocity(mesh, v, f);
      });
    };
    add_of_nodes(faces.liquid, 1, to.paths.values);
    const ToNodes   none;
    NodeVector<dim> along = known_along(state, remembers && now.corrections.empty() ? to : none, bent);
    if (difference.before != 0)
      {
        const Past past = this->past(std::move(now));
        add_of_nodes(faces.deep, -difference.before, change_along(to.paths.part(0, to.n_first), past));
        add(faces.deep, -difference.before, change_along(paths.part(faces.deep - faces.liquid, paths.from.size()), past));
      }
    state.u.update_ghost_values();
    return along;
  }

  template class FaceAdvection<2>;
  template class FaceAdvection<3>;
} // namespace treacle
