// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_appended_data_h
#define treacle_io_appended_data_h

#include <treacle/base/types.h>

#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace treacle
{
  /// VTK's name of a number type.
  template <typename T>
  std::string
  vtk_type()
  {
    if (std::is_same_v<T, float>)
      return "Float32";
    if (std::is_same_v<T, double>)
      return "Float64";
    if (std::is_same_v<T, std::uint8_t>)
      return "UInt8";
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, double> ||
                  std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::int32_t>);
    return "Int32";
  }

  /// The arrays of a VTK XML file, raw behind the markup. The byte order is the
  /// machine's, which is little-endian.
  class AppendedData
  {
  public:
    /// The element that stands for the array in the markup.
    template <typename T>
    std::string
    array(const std::string    &name,
          const unsigned int    n_components,
          const std::vector<T> &values)
    {
      const std::uint64_t n_bytes = values.size() * sizeof(T);
      const std::string   element =
        "<DataArray type=\"" + vtk_type<T>() + "\" Name=\"" + name +
        "\" NumberOfComponents=\"" + std::to_string(n_components) +
        "\" format=\"appended\" offset=\"" + std::to_string(bytes.size()) + "\"/>\n";
      bytes.append(reinterpret_cast<const char *>(&n_bytes), sizeof n_bytes);
      bytes.append(reinterpret_cast<const char *>(values.data()), n_bytes);
      return element;
    }

    /// A whole file: @p body goes into the element of this name.
    void
    write_file(std::ostream &out, const std::string &type, const std::string &body) const
    {
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
          << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<"
          << type << ">\n"
          << body << "</" << type << ">\n<AppendedData encoding=\"raw\">\n_";
      out.write(bytes.data(), bytes.size());
      out << "\n</AppendedData>\n</VTKFile>\n";
    }

  private:
    std::string bytes;
  };
} // namespace treacle

#endif
