// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_face_normal_element_h
#define treacle_mesh_face_normal_element_h

#include <deal.II/fe/fe.h>

namespace treacle
{
  using namespace dealii;

  /// One degree of freedom a face of a simplex: the normal component of the
  /// velocity there. It numbers unknowns; it has no shape functions, for the
  /// method is one of finite volumes.
  template <int dim>
  class FaceNormalElement : public FiniteElement<dim>
  {
  public:
    FaceNormalElement();

    std::unique_ptr<FiniteElement<dim>>
    clone() const override;

    std::string
    get_name() const override;

    UpdateFlags
    requires_update_flags(const UpdateFlags) const override;

  private:
    using MappingData =
      dealii::internal::FEValuesImplementation::MappingRelatedData<dim, dim>;
    using ElementData =
      dealii::internal::FEValuesImplementation::FiniteElementRelatedData<dim, dim>;
    using CellIterator = typename Triangulation<dim>::cell_iterator;
    using InternalData = typename FiniteElement<dim>::InternalDataBase;

    std::unique_ptr<InternalData>
    get_data(const UpdateFlags,
             const Mapping<dim> &,
             const Quadrature<dim> &,
             ElementData &) const override;

    void
    fill_fe_values(const CellIterator &,
                   const CellSimilarity::Similarity,
                   const Quadrature<dim> &,
                   const Mapping<dim> &,
                   const typename Mapping<dim>::InternalDataBase &,
                   const MappingData &,
                   const InternalData &,
                   ElementData &) const override;

    using FiniteElement<dim>::fill_fe_face_values;

    void
    fill_fe_face_values(const CellIterator &,
                        const unsigned int,
                        const hp::QCollection<dim - 1> &,
                        const Mapping<dim> &,
                        const typename Mapping<dim>::InternalDataBase &,
                        const MappingData &,
                        const InternalData &,
                        ElementData &) const override;

    void
    fill_fe_subface_values(const CellIterator &,
                           const unsigned int,
                           const unsigned int,
                           const Quadrature<dim - 1> &,
                           const Mapping<dim> &,
                           const typename Mapping<dim>::InternalDataBase &,
                           const MappingData &,
                           const InternalData &,
                           ElementData &) const override;
  };
} // namespace treacle

#endif
