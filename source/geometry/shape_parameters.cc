// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/shape_parameters.h>

#include <array>
#include <utility>

namespace treacle
{
  namespace
  {
    /// In the order of the kinds.
    constexpr std::array<std::pair<ShapeKind, const char *>, 8> shape_names{
      {{ShapeKind::sphere, "sphere"},
       {ShapeKind::box, "box"},
       {ShapeKind::cylinder, "cylinder"},
       {ShapeKind::capsule, "capsule"},
       {ShapeKind::torus, "torus"},
       {ShapeKind::half_space, "half space"},
       {ShapeKind::triangle_mesh, "triangle mesh"},
       {ShapeKind::expression, "expression"}}};
  } // namespace

  template <int dim>
  void
  ShapeParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    std::string all;
    for (const auto &[kind, name] : shape_names)
      all += (all.empty() ? "" : "|") + std::string(name);
    prm.declare_entry("Shape",
                      shape_names[static_cast<unsigned int>(kind)].second,
                      Patterns::Selection(all),
                      "The body that the other parameters of this subsection describe.");
    prm.add_action("Shape", [this](const std::string &chosen) {
      for (const auto &[kind, name] : shape_names)
        if (name == chosen)
          this->kind = kind;
    });
    prm.add_parameter("Invert", invert, "Take the outside of the body instead.");
    add_plain_bodies(prm);
    prm.add_parameter("Expression",
                      expression,
                      "expression: a formula in x,y,z (2D: x,y) (m, before what is below moves the body) that is near the "
                      "surface like a distance (m), negative inside.");
    add_triangle_mesh(prm);
    add_placement(prm);
  }

  template <int dim>
  void
  ShapeParameters<dim>::add_plain_bodies(ParameterHandler &prm)
  {
    prm.add_parameter("Centre",
                      centre,
                      "sphere, cylinder, torus: the centre (m); half space: a point of "
                      "the plane (m).");
    prm.add_parameter("Radius",
                      radius,
                      "sphere, cylinder (2D: half the width), capsule, torus (of the "
                      "circle in its middle): the radius (m).");
    prm.add_parameter("Minor radius",
                      minor_radius,
                      "torus: the radius (m) of its tube, smaller than Radius; in 2D "
                      "half the width of the annulus.");
    prm.add_parameter("Axis", axis, "cylinder, torus: the direction of the axis.");
    prm.add_parameter("Length", length, "cylinder: the length (m) along the axis.");
    prm.add_parameter("Normal",
                      normal,
                      "half space: the direction normal to the plane, out of the body.");
    prm.add_parameter("Lower corner", lower_corner, "box: the smallest coordinates (m).");
    prm.add_parameter("Upper corner", upper_corner, "box: the largest coordinates (m).");
    prm.add_parameter("Start", start, "capsule: one end (m) of its middle line.");
    prm.add_parameter("End", end, "capsule: the other end (m) of its middle line.");
  }

  template <int dim>
  void
  ShapeParameters<dim>::add_triangle_mesh(ParameterHandler &prm)
  {
    prm.add_parameter("File",
                      file,
                      "triangle mesh: a closed surface, as OFF, OBJ, PLY or STL.",
                      Patterns::FileName());
    prm.add_parameter("Centre at origin",
                      centre_at_origin,
                      "triangle mesh: first move the centre of its bounding box to the "
                      "origin.");
  }

  template <int dim>
  void
  ShapeParameters<dim>::add_placement(ParameterHandler &prm)
  {
    prm.add_parameter("Scale", scale, "Multiply the body's coordinates by this (triangle mesh: m per unit of the file).");
    prm.add_parameter("Rotation axis", rotation_axis, "Then rotate it about this direction (2D: not used) ...");
    prm.add_parameter("Rotation angle", rotation_angle, "... through the origin, by this angle (degrees, right-handed).");
    prm.add_parameter("Translation", translation, "Last move it by this (m).");
  }

  template struct ShapeParameters<2>;
  template struct ShapeParameters<3>;
} // namespace treacle
