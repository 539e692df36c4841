// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_carried_fields_h
#define treacle_transport_carried_fields_h

#include <treacle/mesh/tracer.h>
#include <treacle/transport/back_and_forth.h>

namespace treacle
{
  /// Old node fields, with what a scheme adds to them where they are read.
  template <int dim>
  struct CarriedFields
  {
    std::vector<NodeField<dim>> fields;
    std::vector<Vector>         corrections;

    CarriedFields(CarriedFields &&) = default; // fields refer to corrections

    /// None is added.
    explicit CarriedFields(std::vector<NodeField<dim>> fields)
      : fields(std::move(fields))
    {}

    /// MacCormack's correction of what @p velocity carries on for @p dt, within @p reach (m) of the liquid.
    CarriedFields(std::vector<NodeField<dim>> carried,
                  const State<dim>           &old,
                  const VelocityInStep<dim>  &velocity,
                  const double                dt,
                  const double                reach)
      : fields(std::move(carried))
    {
      std::vector<const Vector *> values;
      for (const NodeField<dim> &field : fields)
        values.push_back(field.value);
      std::vector<LocalIndex> known, corrected;
      for (LocalIndex node = 0; node < old.mesh->n_owned_nodes(); ++node)
        {
          const double phi = old.phi.local_element(node);
          if (phi < reach)
            known.push_back(node);
          if (phi < 0) // fields in the air are not smooth
            corrected.push_back(node);
        }
      corrections = back_and_forth_error<dim>(*old.mesh, values, velocity, dt, known, corrected);
      for (unsigned int k = 0; k < fields.size(); ++k)
        fields[k].correction = &corrections[k];
    }
  };
} // namespace treacle

#endif
