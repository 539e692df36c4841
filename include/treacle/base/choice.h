// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_choice_h
#define treacle_base_choice_h

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <string>
#include <vector>

namespace treacle
{
  using namespace dealii;

  /// The values of an enum with the names that files have for them, in the order in
  /// which people read them.
  template <typename Enum>
  class Choice
  {
  public:
    Choice(const std::initializer_list<std::pair<std::string, Enum>> &entries)
      : entries(entries)
    {}

    bool
    has(const std::string &name) const
    {
      return std::any_of(entries.begin(), entries.end(), [&](const auto &entry) {
        return entry.first == name;
      });
    }

    /// The value of a name that there is.
    Enum
    value(const std::string &name) const
    {
      const auto it =
        std::find_if(entries.begin(), entries.end(), [&](const auto &entry) {
          return entry.first == name;
        });
      AssertThrow(it != entries.end(), ExcMessage("No choice is called " + name));
      return it->second;
    }

    /// The name of a value.
    const std::string &
    name(const Enum value) const
    {
      const auto it =
        std::find_if(entries.begin(), entries.end(), [&](const auto &entry) {
          return entry.second == value;
        });
      AssertThrow(it != entries.end(), ExcMessage("A choice has no name"));
      return it->first;
    }

    /// All names.
    std::string
    names(const std::string &separator) const
    {
      std::string text;
      for (const auto &entry : entries)
        text += (text.empty() ? "" : separator) + entry.first;
      return text;
    }

  private:
    std::vector<std::pair<std::string, Enum>> entries;
  };

  /// Declare a parameter that is one of the names of @p choice, as @p value is now;
  /// parsing writes into @p value.
  template <typename Enum>
  void
  add_choice(ParameterHandler   &prm,
             const std::string  &name,
             Enum               &value,
             const std::string  &documentation,
             const Choice<Enum> &choice)
  {
    prm.declare_entry(name,
                      choice.name(value),
                      Patterns::Selection(choice.names("|")),
                      documentation);
    prm.add_action(name, [&value, choice](const std::string &text) {
      value = choice.value(text);
    });
  }
} // namespace treacle

#endif
