// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

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
    const NodeVector<dim> &v = *old.before->v;
    return {std::move(now),
            carry(fields_of(v), velocity.carried[2], difference.dt + old.before->dt),
            combined(0.5, old.v, 0.5, v),
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
  FaceAdvection<dim>::change_along(Paths &&paths, const Past &past, const std::vector<NodeField<dim>> &before) const
  {
    const Tracer<dim> tracer(*old.mesh);
    Guesses           cells   = paths.cells;
    const auto        further = tracer.trace(paths.from, past.between, -old.before->dt, paths.cells);
    const auto        values  = tracer.evaluate(further, before, paths.cells);
    std::transform(
      paths.values.begin(), paths.values.end(), values.begin(), paths.values.begin(), std::minus<>());
    past.fall.set_change(paths.values, paths.from, cells, old.before->dt);
    return std::move(paths.values);
  }

  template <int dim>
  typename FaceAdvection<dim>::AtNodes
  FaceAdvection<dim>::at_nodes(const CarriedFields<dim>      &now,
                               const Past                    *past,
                               const Mesh<dim>               &mesh,
                               const std::vector<LocalIndex> &faces) const
  {
    Vector is_needed = mesh.zeros(mesh.nodes);
    for (const LocalIndex f : faces)
      for (const LocalIndex node : mesh.face_nodes[f])
        is_needed.local_element(node) = 1;
    is_needed.compress(VectorOperation::add);
    std::vector<LocalIndex> nodes;
    PathEnds<dim>           ends(mesh, *old.mesh, velocity.carried[4]);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (is_needed.local_element(node) > 0)
        {
          nodes.push_back(node);
          ends.add_node(node);
        }
    AtNodes    result{NodeVector<dim>(mesh.nodes), NodeVector<dim>(mesh.nodes)};
    const auto set = [&](NodeVector<dim> &v, const std::vector<double> &values) {
      for (unsigned int i = 0; i < values.size(); ++i)
        v.component[i % dim].local_element(nodes[i / dim]) = values[i];
      v.update_ghost_values();
    };
    Paths paths = paths_to(std::move(ends), now.fields);
    set(result.now, paths.values);
    if (past != nullptr)
      set(result.change, change_along(std::move(paths), *past, past->before.fields));
    return result;
  }

  template <int dim>
  void
  FaceAdvection<dim>::advance(State<dim> &state) const
  {
    const Mesh<dim>      &mesh = *state.mesh;
    const FaceGroups<dim> faces(state);
    PathEnds<dim>         ends(mesh, *old.mesh, velocity.carried[4]);
    std::for_each(faces.liquid, faces.all.end(), [&](const LocalIndex f) { ends.add_face(f); });
    const auto add = [&](const auto begin, const double weight, const std::vector<double> &values) {
      for (unsigned int i = 0; i < values.size(); ++i)
        state.u.local_element(begin[i / dim]) += weight * mesh.face_normal[begin[i / dim]][i % dim] * values[i];
    };
    const auto add_of_nodes = [&](const auto end, const double weight, const NodeVector<dim> &v) {
      std::for_each(faces.all.begin(), end, [&](const LocalIndex f) {
        state.u.local_element(f) += weight * face_velocity(mesh, v, f);
      });
    };
    CarriedFields<dim> now = carry(fields_of(old.v), velocity.carried, difference.dt);
    // a scheme's corrections do the same, and faces of another mesh have no nodes here
    const Vector bends = now.corrections.empty() && &mesh == old.mesh.get() ? bending_nodes(domain, difference.dt) : Vector();
    const VelocityCurvature<dim> curvature(mesh, old.v, bends);
    Paths paths = paths_to(std::move(ends), curvature.bent(now.fields));
    add(faces.liquid, 1, paths.values);
    std::for_each(faces.liquid, faces.all.end(), [&](const LocalIndex f) {
      state.u.local_element(f) -= mesh.face_normal[f] * curvature.at_face(f);
    });
    keep_what_nodes_miss(old, domain, difference, mesh, faces.all, state.u);
    std::optional<Past> past;
    if (difference.before != 0)
      past.emplace(this->past(std::move(now)));
    const AtNodes nodes = past ? at_nodes(past->now, &*past, mesh, {faces.all.begin(), faces.deep}) :
                                 at_nodes(now, nullptr, mesh, {faces.all.begin(), faces.liquid});
    add_of_nodes(faces.liquid, 1, nodes.now);
    if (past)
      {
        add_of_nodes(faces.deep, -difference.before, nodes.change);
        paths.drop(faces.deep - faces.liquid);
        const VelocityCurvature<dim> curvature_before(mesh, *old.before->v, bends);
        add(faces.deep, -difference.before, change_along(std::move(paths), *past, curvature_before.bent(past->before.fields)));
      }
    state.u.update_ghost_values();
  }

  template class FaceAdvection<2>;
  template class FaceAdvection<3>;
} // namespace treacle
