// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/surface/smooth_level_set.h>

namespace treacle
{
  template <int dim>
  SmoothLevelSet<dim>::SmoothLevelSet(const Mesh<dim> &mesh, const Vector &phi)
    : mesh(mesh)
    , phi(phi)
    , gradient(nodal_gradient(mesh, phi))
    , smoothness(mesh.nodes)
  {
    // at kinks the mean over the cells around is shorter than 1
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      smoothness.local_element(node) = std::abs(gradient.value(node).norm() - 1) < 0.1;
    smoothness.update_ghost_values();
  }

  template <int dim>
  std::vector<double>
  SmoothLevelSet<dim>::values(const std::vector<Point<dim>> &x, Guesses &guesses) const
  {
    return Tracer<dim>(mesh).evaluate(x, {{&phi, &gradient, &smoothness}}, guesses);
  }

  template <int dim>
  std::vector<typename SmoothLevelSet<dim>::Sample>
  SmoothLevelSet<dim>::samples(const std::vector<Point<dim>> &x, Guesses &guesses) const
  {
    std::vector<NodeField<dim>> fields = {{&phi, &gradient, &smoothness}, {&smoothness}};
    for (const Vector &component : gradient.component)
      fields.push_back({&component});
    const std::vector<double> numbers = Tracer<dim>(mesh).evaluate(x, fields, guesses);
    std::vector<Sample>       samples(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const double *n       = &numbers[(dim + 2) * i];
        samples[i].value      = n[0];
        samples[i].smoothness = n[1];
        for (unsigned int d = 0; d < dim; ++d)
          samples[i].gradient[d] = n[2 + d];
      }
    return samples;
  }

  template class SmoothLevelSet<2>;
  template class SmoothLevelSet<3>;
} // namespace treacle
