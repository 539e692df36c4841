// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/work.h>
#include <treacle/solvers/balancing.h>

#include <deal.II/base/mpi.h>

namespace treacle
{
  namespace
  {
    /// Of its energy, below which what a motion adds to others is rounding; and of that which it would have if
    /// the unknowns did not know each other, below which all of it is.
    constexpr double least_part = 1e-8, least_energy = 1e-13;
  } // namespace

  Balancing::Balancing(const TrilinosWrappers::SparseMatrix &matrix, PartMotions motions)
    : comm(matrix.get_mpi_communicator())
    , parts(std::move(motions))
    , images(parts.values.size())
  {
    const unsigned int n = parts.n_motions;
    Vector             x(matrix.locally_owned_range_indices(), comm), y(x);
    for (unsigned int k = 0; k < n; ++k)
      {
        for (unsigned int i = 0; i < parts.rows.size(); ++i)
          x.local_element(parts.rows[i]) = parts.values[n * i + k];
        matrix.vmult(y, x);
        for (unsigned int i = 0; i < parts.rows.size(); ++i)
          images[n * i + k] = y.local_element(parts.rows[i]);
      }
    Work::here().products += n;
    std::vector<double> diagonal;
    const int           first = x.get_partitioner()->local_range().first;
    for (const unsigned int row : parts.rows)
      diagonal.push_back(matrix.diag_element(first + row));
    make_orthonormal(diagonal);
  }

  std::vector<double>
  Balancing::energies(const std::vector<double> &diagonal) const
  {
    const unsigned int  n = parts.n_motions;
    std::vector<double> result(n * (n + 1) * parts.n_parts, 0.);
    for (unsigned int i = 0; i < parts.rows.size(); ++i)
      for (unsigned int k = 0; k < n; ++k)
        {
          double *energy = result.data() + (n + 1) * (n * parts.part[i] + k);
          for (unsigned int l = 0; l < n; ++l)
            energy[l] += parts.values[n * i + k] * images[n * i + l];
          energy[n] += parts.values[n * i + k] * diagonal[i] * parts.values[n * i + k];
        }
    Utilities::MPI::sum(result, comm, result);
    return result;
  }

  void
  Balancing::make_orthonormal(const std::vector<double> &diagonal)
  {
    // by the inverse of each part's Cholesky factor, whose diagonal is inverted
    const unsigned int  n = parts.n_motions, m = n + 1;
    std::vector<double> factor = energies(diagonal);
    for (unsigned int p = 0; p < parts.n_parts; ++p)
      for (unsigned int k = 0; k < n; ++k)
        {
          double      *others = factor.data() + m * n * p, *l = others + m * k;
          const double least = std::max(least_part * l[k], least_energy * l[n]);
          for (unsigned int j = 0; j <= k; ++j)
            {
              for (unsigned int i = 0; i < j; ++i)
                l[j] -= l[i] * others[m * j + i];
              if (j < k)
                l[j] *= others[m * j + j];
            }
          l[k] = l[k] > least ? 1 / std::sqrt(l[k]) : 0.;
        }
    for (unsigned int i = 0; i < parts.rows.size(); ++i)
      {
        const double *l = factor.data() + m * n * parts.part[i];
        for (std::vector<double> *vectors : {&parts.values, &images})
          for (unsigned int k = 0; k < n; ++k)
            {
              double &value = (*vectors)[n * i + k];
              for (unsigned int j = 0; j < k; ++j)
                value -= l[m * k + j] * (*vectors)[n * i + j];
              value *= l[m * k + k];
            }
      }
  }

  std::vector<double>
  Balancing::products(const std::vector<double> &vectors, const Vector &x) const
  {
    const unsigned int  n = parts.n_motions;
    std::vector<double> result(n * parts.n_parts, 0.);
    for (unsigned int i = 0; i < parts.rows.size(); ++i)
      for (unsigned int k = 0; k < n; ++k)
        result[n * parts.part[i] + k] += vectors[n * i + k] * x.local_element(parts.rows[i]);
    Utilities::MPI::sum(result, comm, result);
    return result;
  }

  void
  Balancing::add(Vector                    &x,
                 const double               factor,
                 const std::vector<double> &coefficients,
                 const std::vector<double> &vectors) const
  {
    const unsigned int n = parts.n_motions;
    for (unsigned int i = 0; i < parts.rows.size(); ++i)
      for (unsigned int k = 0; k < n; ++k)
        x.local_element(parts.rows[i]) += factor * coefficients[n * parts.part[i] + k] * vectors[n * i + k];
  }

  void
  Balancing::apply(Vector &z, const Vector &r, const Operator &preconditioner) const
  {
    std::vector<double> coefficients = products(parts.values, r);
    Vector              rest(r);
    add(rest, -1, coefficients, images);
    preconditioner(z, rest);
    const std::vector<double> too_much = products(images, z);
    for (unsigned int k = 0; k < coefficients.size(); ++k)
      coefficients[k] -= too_much[k];
    add(z, 1, coefficients, parts.values);
  }
} // namespace treacle
