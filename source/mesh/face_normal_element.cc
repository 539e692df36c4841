// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/face_normal_element.h>

#include <deal.II/grid/reference_cell.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    FiniteElementData<dim>
    one_per_face()
    {
      std::vector<unsigned int> dofs_per_object(dim + 1, 0);
      dofs_per_object[dim - 1] = 1;
      return FiniteElementData<dim>(dofs_per_object,
                                    ReferenceCells::get_simplex<dim>(),
                                    1,
                                    0,
                                    FiniteElementData<dim>::L2);
    }
  } // namespace

  template <int dim>
  FaceNormalElement<dim>::FaceNormalElement()
    : FiniteElement<dim>(one_per_face<dim>(),
                         std::vector<bool>(dim + 1, true),
                         std::vector<ComponentMask>(dim + 1,
                                                    ComponentMask(1, true)))
  {}

  template <int dim>
  std::unique_ptr<FiniteElement<dim>>
  FaceNormalElement<dim>::clone() const
  {
    return std::make_unique<FaceNormalElement<dim>>(*this);
  }

  template <int dim>
  std::string
  FaceNormalElement<dim>::get_name() const
  {
    return "FaceNormalElement<" + std::to_string(dim) + ">()";
  }

  template <int dim>
  UpdateFlags
  FaceNormalElement<dim>::requires_update_flags(const UpdateFlags) const
  {
    return update_default;
  }

  template <int dim>
  std::unique_ptr<typename FiniteElement<dim>::InternalDataBase>
  FaceNormalElement<dim>::get_data(const UpdateFlags,
                                   const Mapping<dim> &,
                                   const Quadrature<dim> &,
                                   ElementData &) const
  {
    return std::make_unique<InternalData>();
  }

  template <int dim>
  void
  FaceNormalElement<dim>::fill_fe_values(
    const CellIterator &,
    const CellSimilarity::Similarity,
    const Quadrature<dim> &,
    const Mapping<dim> &,
    const typename Mapping<dim>::InternalDataBase &,
    const MappingData &,
    const InternalData &,
    ElementData &) const
  {}

  template <int dim>
  void
  FaceNormalElement<dim>::fill_fe_face_values(
    const CellIterator &,
    const unsigned int,
    const hp::QCollection<dim - 1> &,
    const Mapping<dim> &,
    const typename Mapping<dim>::InternalDataBase &,
    const MappingData &,
    const InternalData &,
    ElementData &) const
  {}

  template <int dim>
  void
  FaceNormalElement<dim>::fill_fe_subface_values(
    const CellIterator &,
    const unsigned int,
    const unsigned int,
    const Quadrature<dim - 1> &,
    const Mapping<dim> &,
    const typename Mapping<dim>::InternalDataBase &,
    const MappingData &,
    const InternalData &,
    ElementData &) const
  {}

  template class FaceNormalElement<2>;
  template class FaceNormalElement<3>;
} // namespace treacle
