// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/io/row_order.h>

namespace treacle
{
  template <int dim>
  RowOrder<dim>::RowOrder(const Mesh<dim> &mesh, const unsigned int size)
    : mesh(mesh)
    , size(size)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(mesh.communicator());
    const unsigned int rank    = Utilities::MPI::this_mpi_process(mesh.communicator());
    const GlobalIndex  share   = (mesh.cells->size() + n_ranks - 1) / n_ranks;
    first                      = std::min(rank * share, mesh.cells->size());
    n_rows                     = std::min(share, mesh.cells->size() - first);

    sent_to.resize(n_ranks);
    PerRank<GlobalIndex> numbers(n_ranks);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        const unsigned int r = mesh.cell_number[c] / share;
        sent_to[r].push_back(c);
        numbers[r].push_back(mesh.cell_number[c]);
      }
    received_from = send_and_receive(mesh.communicator(), numbers);
  }

  template <int dim>
  std::vector<double>
  RowOrder<dim>::shares(const std::vector<double> &rows) const
  {
    PerRank<double> sent(sent_to.size());
    for (unsigned int r = 0; r < sent.size(); ++r)
      for (const LocalIndex c : sent_to[r])
        sent[r].insert(sent[r].end(), rows.begin() + c * size, rows.begin() + (c + 1) * size);
    const auto          received = send_and_receive(mesh.communicator(), sent);
    std::vector<double> result(n_numbers());
    for (unsigned int r = 0; r < received.size(); ++r)
      for (unsigned int k = 0; k < received_from[r].size(); ++k)
        std::copy_n(&received[r][k * size], size, &result[(received_from[r][k] - first) * size]);
    return result;
  }

  template <int dim>
  std::vector<double>
  RowOrder<dim>::rows(const std::vector<double> &share) const
  {
    PerRank<double> sent(received_from.size());
    for (unsigned int r = 0; r < sent.size(); ++r)
      for (const GlobalIndex number : received_from[r])
        {
          const auto begin = share.begin() + (number - first) * size;
          sent[r].insert(sent[r].end(), begin, begin + size);
        }
    const auto          received = send_and_receive(mesh.communicator(), sent);
    std::vector<double> result(mesh.n_owned_cells() * size);
    for (unsigned int r = 0; r < received.size(); ++r)
      for (unsigned int k = 0; k < sent_to[r].size(); ++k)
        std::copy_n(&received[r][k * size], size, &result[sent_to[r][k] * size]);
    return result;
  }

  template class RowOrder<2>;
  template class RowOrder<3>;
} // namespace treacle
