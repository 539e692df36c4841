// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_exceptions_h
#define treacle_base_exceptions_h

#include <deal.II/base/exceptions.h>

#include <sstream>
#include <stdexcept>
#include <string>

namespace treacle
{
  /// What a user can cause and mend: the message names the parameter or the
  /// place and says what is allowed. main() prints it alone and exits with 1.
  class UserError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A number for people, with six digits.
  inline std::string
  digits(const double x)
  {
    std::ostringstream text;
    text << x;
    return text.str();
  }

  /// Run @p evaluate on this rank; the first message of a UserError is kept, for
  /// throw_first() to throw on all ranks.
  template <typename Function>
  void
  keep_error(std::string &error, const Function &evaluate)
  {
    try
      {
        evaluate();
      }
    catch (const UserError &e)
      {
        if (error.empty())
          error = e.what();
      }
  }

  /// Throw a UserError unless @p condition holds.
  inline void
  require(const bool condition, const std::string &message)
  {
    if (!condition)
      throw UserError(message);
  }
} // namespace treacle

#endif
