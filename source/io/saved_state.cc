// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/moved_points.h>
#include <treacle/io/row_order.h>
#include <treacle/io/saved_state.h>
#include <treacle/io/table_file.h>

#include <iomanip>
#include <limits>
#include <sstream>

namespace treacle
{
  namespace
  {
    /// The vectors of a state, const or not, that are saved.
    template <typename AnyVector>
    struct Saved
    {
      std::vector<AnyVector *> at_nodes, at_faces, in_cells;

      template <typename AnyState>
      explicit Saved(AnyState &state)
        : at_nodes{&state.phi}
        , at_faces{&state.u}
        , in_cells{&state.pressure}
      {
        for (auto &component : state.v.component)
          at_nodes.push_back(&component);
        if (state.before && state.before->v)
          for (auto *v : {&*state.before->v, &*state.before->v_along})
            for (auto &component : v->component)
              at_nodes.push_back(&component);
        if (state.before && state.before->u)
          at_faces.push_back(&*state.before->u);
        if (state.material)
          {
            for (auto *field : {&state.material->density, &state.material->viscosity})
              for (auto *v : {&field->mean, &field->least, &field->largest})
                at_nodes.push_back(v);
          }
      }

      template <typename Visit>
      void
      for_each(const Visit &visit) const
      {
        for (const auto *list : {&at_nodes, &at_faces, &in_cells})
          for (AnyVector *v : *list)
            visit(*v);
      }
    };

    /// The row of a cell holds what is at those of its nodes and faces that belong to no cell
    /// of a lower number, and in the cell: each number of a state is in one row.
    template <int dim>
    class Rows
    {
    public:
      explicit Rows(const Mesh<dim> &mesh)
        : mesh(mesh)
        , first_cell(mesh.node_position.size(), std::numeric_limits<GlobalIndex>::max())
      {
        // all cells around a node of an owned cell are known here
        for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
          for (const LocalIndex node : mesh.cell_nodes[c])
            first_cell[node] = std::min(first_cell[node], mesh.cell_number[c]);
      }

      /// Call @p visit with each number of the row of an owned cell in turn.
      template <typename AnyVector, typename Visit>
      void
      for_each_number(const LocalIndex cell, const Saved<AnyVector> &saved, const Visit &visit) const
      {
        for (const LocalIndex node : mesh.cell_nodes[cell])
          if (first_cell[node] == mesh.cell_number[cell])
            for (AnyVector *v : saved.at_nodes)
              visit(*v, node);
        for (const LocalIndex face : mesh.cell_faces[cell])
          if (mesh.face_cells[face][0] == cell)
            for (AnyVector *v : saved.at_faces)
              visit(*v, face);
        for (AnyVector *v : saved.in_cells)
          visit(*v, cell);
      }

      template <typename AnyVector>
      RowOrder<dim>
      order(const Saved<AnyVector> &saved) const
      {
        std::vector<unsigned int> sizes(mesh.n_owned_cells(), 0);
        for (LocalIndex c = 0; c < sizes.size(); ++c)
          for_each_number(c, saved, [&](AnyVector &, const LocalIndex) { ++sizes[c]; });
        return {mesh, sizes};
      }

    private:
      const Mesh<dim>         &mesh;
      std::vector<GlobalIndex> first_cell; ///< lowest number of a cell around each node
    };

    template <int dim>
    void
    write_numbers(const State<dim> &state, const std::string &path)
    {
      const Mesh<dim>          &mesh = *state.mesh;
      const Saved<const Vector> saved(state);
      const Rows<dim>           rows(mesh);
      for (const auto *list : {&saved.at_nodes, &saved.at_faces})
        for (const Vector *v : *list)
          v->update_ghost_values();
      std::vector<double> numbers;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        rows.for_each_number(c, saved, [&](const Vector &v, const LocalIndex i) {
          numbers.push_back(v.local_element(i));
        });
      TableFile<double>::write(mesh.communicator(), path, rows.order(saved).shares(numbers));
    }

    template <int dim>
    void
    read_numbers(State<dim> &state, const std::string &path)
    {
      const Mesh<dim>    &mesh = *state.mesh;
      const Saved<Vector> saved(state);
      const Rows<dim>     rows(mesh);
      const RowOrder<dim> order = rows.order(saved);
      const auto          numbers =
        order.rows(TableFile<double>::read(mesh.communicator(), path, order.offset(), order.n_numbers()));

      // one rank knows each number, not always the owner, who adds up what others know. To
      // add -0 changes nothing, not the sign of a zero either
      saved.for_each([](Vector &v) { fill(v, -0.); });
      auto next = numbers.begin();
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        rows.for_each_number(c, saved, [&](Vector &v, const LocalIndex i) {
          v.local_element(i) = *next++;
        });
      saved.for_each([](Vector &v) {
        v.compress(VectorOperation::add);
        v.update_ghost_values();
      });
    }

    template <typename Item>
    void
    write_items(const MPI_Comm &comm, const std::vector<Item> &items, const std::string &path)
    {
      std::vector<double> numbers;
      for (const Item &item : items)
        {
          const auto of_item = item.numbers();
          numbers.insert(numbers.end(), of_item.begin(), of_item.end());
        }
      TableFile<double>::write(comm, path, numbers);
    }

    /// Each rank reads an even part; in this order a rank has its markers, or material points, in the
    /// order in which it saved them.
    template <int dim, template <int> class Item>
    void
    read_items(const Mesh<dim>        &mesh,
               const std::string      &path,
               const std::uint64_t     n,
               std::vector<Item<dim>> &items)
    {
      const MPI_Comm         &comm    = mesh.communicator();
      const std::uint64_t     rank    = Utilities::MPI::this_mpi_process(comm);
      const std::uint64_t     n_ranks = Utilities::MPI::n_mpi_processes(comm);
      const std::uint64_t     begin   = n * rank / n_ranks, end = n * (rank + 1) / n_ranks;
      constexpr std::uint64_t size    = std::tuple_size<typename Item<dim>::Numbers>::value;
      const auto              numbers =
        TableFile<double>::read(comm, path, size * begin, size * (end - begin));
      items.clear();
      for (std::uint64_t k = 0; k < end - begin; ++k)
        items.push_back(Item<dim>::from(&numbers[size * k]));
      items = to_owners(mesh, items);
    }
  } // namespace

  template <int dim>
  std::string
  write_state(const State<dim> &state, const std::string &directory)
  {
    write_numbers(state, directory + "/numbers");
    const MPI_Comm &comm = state.mesh->communicator();
    const auto      save = [&](const auto &items, const std::string &name) {
      write_items(comm, items, directory + "/" + name);
      return Utilities::MPI::sum(static_cast<std::uint64_t>(items.size()), comm);
    };
    std::ostringstream out;
    out << std::setprecision(17) << "Time = " << state.time << "\nStep = " << state.step
        << "\nVelocity before = "
        << (!state.before     ? "none" :
            !state.before->v  ? "faces" :
            !state.before->u  ? "nodes" :
                                "nodes and faces")
        << "\nStep before = " << (state.before ? state.before->dt : 0.)
        << "\nAdvected material = " << (state.material ? "true" : "false")
        << "\nMarkers = " << save(state.markers, "markers") << '\n';
    if (state.material)
      out << "Material points = " << save(state.material->points, "material_points") << '\n';
    return out.str();
  }

  template <int dim>
  State<dim>
  read_state(std::shared_ptr<const Mesh<dim>> mesh,
             const std::string               &directory,
             const CheckpointInfo            &info)
  {
    State<dim> state(mesh);
    if (info.get("Advected material") == "true")
      state.material.emplace(mesh->nodes);
    if (const std::string before = info.get("Velocity before"); before != "none")
      {
        state.before.emplace();
        state.before->dt = info.number("Step before");
        if (before != "faces")
          for (auto *v : {&state.before->v, &state.before->v_along})
            v->emplace(mesh->nodes);
        if (before != "nodes")
          state.before->u.emplace(mesh->faces);
      }
    state.time = info.number("Time");
    state.step = info.count("Step");
    read_numbers(state, directory + "/numbers");
    read_items(*mesh, directory + "/markers", info.count("Markers"), state.markers);
    if (state.material)
      read_items(*mesh,
                 directory + "/material_points",
                 info.count("Material points"),
                 state.material->points);
    return state;
  }

#define INSTANTIATE(dim)                                                         \
  template std::string write_state(const State<dim> &, const std::string &);     \
  template State<dim>  read_state(std::shared_ptr<const Mesh<dim>>,              \
                                 const std::string &,                           \
                                 const CheckpointInfo &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
