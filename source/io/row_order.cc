// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/io/row_order.h>

namespace treacle
{
  namespace
  {
    /// Where rows of these sizes begin, and the end of the last.
    template <typename Sizes>
    std::vector<std::uint64_t>
    starts(const Sizes &sizes)
    {
      std::vector<std::uint64_t> result(1, 0);
      for (const auto size : sizes)
        result.push_back(result.back() + size);
      return result;
    }

    void
    append_row(std::vector<double>              &to,
               const std::vector<double>        &from,
               const std::vector<std::uint64_t> &start,
               const std::uint64_t               row)
    {
      to.insert(to.end(), from.begin() + start[row], from.begin() + start[row + 1]);
    }
  } // namespace

  template <int dim>
  RowOrder<dim>::RowOrder(const Mesh<dim> &mesh, const std::vector<unsigned int> &sizes)
    : comm(mesh.communicator())
    , own_start(starts(sizes))
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const Share        share =
      share_of(Utilities::MPI::this_mpi_process(comm), n_ranks, mesh.cells->size());
    const std::uint64_t most = share_of(0, n_ranks, mesh.cells->size()).n;

    using NumberAndSize = std::array<std::uint64_t, 2>;
    PerRank<NumberAndSize> rows(n_ranks);
    sent_to.resize(n_ranks);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        const unsigned int r = mesh.cell_number[c] / most;
        sent_to[r].push_back(c);
        rows[r].push_back({{mesh.cell_number[c], sizes[c]}});
      }
    rows = send_and_receive(comm, rows);

    std::vector<std::uint64_t> share_sizes(share.n);
    received_from.resize(n_ranks);
    for (unsigned int r = 0; r < n_ranks; ++r)
      for (const auto &[number, size] : rows[r])
        {
          received_from[r].push_back(number - share.first);
          share_sizes[number - share.first] = size;
        }
    start = starts(share_sizes);
    n_before = sum_of_lower_ranks(comm, start.back());
  }

  template <int dim>
  std::vector<double>
  RowOrder<dim>::shares(const std::vector<double> &rows) const
  {
    PerRank<double> sent(sent_to.size());
    for (unsigned int r = 0; r < sent.size(); ++r)
      for (const LocalIndex c : sent_to[r])
        append_row(sent[r], rows, own_start, c);
    const auto          received = send_and_receive(comm, sent);
    std::vector<double> result(n_numbers());
    for (unsigned int r = 0; r < received.size(); ++r)
      {
        auto next = received[r].begin();
        for (const std::uint64_t row : received_from[r])
          for (std::uint64_t k = start[row]; k < start[row + 1]; ++k)
            result[k] = *next++;
      }
    return result;
  }

  template <int dim>
  std::vector<double>
  RowOrder<dim>::rows(const std::vector<double> &share) const
  {
    PerRank<double> sent(received_from.size());
    for (unsigned int r = 0; r < sent.size(); ++r)
      for (const std::uint64_t row : received_from[r])
        append_row(sent[r], share, start, row);
    const auto          received = send_and_receive(comm, sent);
    std::vector<double> result(own_start.back());
    for (unsigned int r = 0; r < received.size(); ++r)
      {
        auto next = received[r].begin();
        for (const LocalIndex c : sent_to[r])
          for (std::uint64_t k = own_start[c]; k < own_start[c + 1]; ++k)
            result[k] = *next++;
      }
    return result;
  }

  template class RowOrder<2>;
  template class RowOrder<3>;
} // namespace treacle
