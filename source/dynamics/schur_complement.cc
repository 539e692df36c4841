// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/maximum.h>
#include <treacle/dynamics/schur_complement.h>

namespace treacle
{
  namespace
  {
    /// Of mu step over rho h^2: less than this is none.
    constexpr double least_viscosity = 1e-12;
    /// The library's 1e-12 is much beside the volume over viscosity of rock.
    constexpr double least_diagonal = std::numeric_limits<double>::min();
    /// Over so much of the liquid's extent viscosity acts in a step where it rules.
    constexpr double far = 0.1;
  } // namespace

  template <int dim>
  SchurComplement<dim>::SchurComplement(const PressureSystem<dim> &pressure,
                                        const Hybrid<dim>         &hybrid,
                                        const double               step)
    : pressure(pressure)
    , domain(pressure.domain)
    , step(step)
    , needs_projection(!viscosity_rules())
    , viscous(viscous_part(hybrid))
    , z_projection(pressure.rows(), domain.mesh.communicator())
  {
    // over its diagonal most of it has eigenvalues from 0.05 to 2, whatever mesh and viscosity are
    if (pressure.rows().size() > 0)
      viscous_inverse.initialize(*viscous, {8, 2., 50., 1., least_diagonal});
  }

  template <int dim>
  bool
  SchurComplement<dim>::viscosity_rules() const
  {
    const Mesh<dim>                &mesh = domain.mesh;
    std::array<double, 2 * dim + 1> most; // of x, -x, and of what is the least
    most.fill(-std::numeric_limits<double>::max());
    for (const LocalIndex c : pressure.cells())
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            most[d]       = std::max(most[d], mesh.cell_dual[c][d]);
            most[dim + d] = std::max(most[dim + d], -mesh.cell_dual[c][d]);
          }
        most[2 * dim] = std::max(most[2 * dim], -domain.viscosity[c] * step / domain.density[c]);
      }
    most          = largest(mesh.communicator(), most);
    double extent = 0;
    for (unsigned int d = 0; d < dim; ++d)
      extent = std::max(extent, most[d] + most[dim + d]);
    return -most[2 * dim] > std::pow(far * extent, 2);
  }

  template <int dim>
  double
  SchurComplement<dim>::viscosity_felt(const LocalIndex cell) const
  {
    const auto jump = domain.viscosity_jumps.find(cell);
    return jump == domain.viscosity_jumps.end() ? domain.viscosity[cell] : std::max(domain.viscosity[cell], jump->second.mean());
  }

  template <int dim>
  std::unique_ptr<const TrilinosWrappers::SparseMatrix>
  SchurComplement<dim>::viscous_part(const Hybrid<dim> &hybrid) const
  {
    const Mesh<dim>    &mesh = domain.mesh;
    std::vector<double> mass;
    for (const LocalIndex c : pressure.cells())
      {
        double open = 0, all = 0; // squares of areas
        for (const LocalIndex f : mesh.cell_faces[c])
          {
            open += std::pow(domain.open_fraction[f] * mesh.face_area[f], 2);
            all += std::pow(mesh.face_area[f], 2);
          }
        // little goes out of a cell that solids or emitters all but close
        const double volume = std::min(domain.open_volume(c), open / all * mesh.cell_volume[c]);
        const double mu_dt =
          std::max(viscosity_felt(c) * step,
                   least_viscosity * domain.density[c] * std::pow(mesh.cell_size[c], 2));
        mass.push_back(volume / (2 * mu_dt));
      }
    return pressure.assemble(
      [&](const LocalIndex f) { return hybrid.rest[f] / domain.face_mass[f]; }, mass);
  }

  template <int dim>
  void
  SchurComplement<dim>::invert(Vector &z, const Vector &r) const
  {
    viscous_inverse.vmult(z, r);
    if (!needs_projection)
      return;
    pressure.precondition(z_projection, r);
    z += z_projection;
  }

  template <int dim>
  Vector
  SchurComplement<dim>::inverse_diagonal() const
  {
    Vector result(z_projection);
    for (const GlobalIndex row : pressure.rows())
      result(row) = 1 / pressure.projection().diag_element(row) + 1 / viscous->diag_element(row);
    return result;
  }

  template class SchurComplement<2>;
  template class SchurComplement<3>;
} // namespace treacle
