// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/scene/parameter_file.h>
#include <treacle/scene/parameter_lines.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace treacle
{
  namespace
  {
    using Line = ParameterLine;

    std::string
    join(const std::vector<std::string> &parts, const std::string &separator)
    {
      std::string result;
      for (const std::string &part : parts)
        result += (result.empty() ? "" : separator) + part;
      return result;
    }

    std::string
    read_file(const std::string &name)
    {
      std::ifstream      file(name);
      std::ostringstream text;
      require(file && (file.peek() == EOF || text << file.rdbuf()) && !file.bad(),
              "The parameter file \"" + name + "\" cannot be read.");
      return text.str();
    }

    /// The names that @p prm declares in a subsection, and those of subsections.
    std::string
    names_in(const ParameterHandler         &prm,
             const std::vector<std::string> &path,
             const Line::Kind                kind)
    {
      std::ostringstream text;
      prm.print_parameters(text, ParameterHandler::ShortText);
      std::vector<std::string> names;
      for (const Line &line : parameter_lines(text.str()))
        if (line.kind == kind && line.path == path)
          names.push_back(line.name);
      return names.empty() ? "none" : join(names, ", ");
    }

    /// What a pattern allows, from deal.II's code for it.
    std::string
    in_words(const std::string &pattern)
    {
      std::string text = Utilities::trim(
        Patterns::pattern_factory(pattern)->description(Patterns::PatternBase::Text));
      const std::vector<std::pair<const char *, const char *>> replacements{
        {"-?MAX_(DOUBLE|INT) <= | <= MAX_(DOUBLE|INT)", ""},
        {"A floating point number v such that v\\b", "A number"},
        {"An integer n such that n\\b", "An integer"},
        {"A list of ([0-9]+) to \\1 elements", "A list of $1 elements"},
        {"separated by <([^>]*)>", "separated by $1"}};
      for (const auto &[from, to] : replacements)
        text = std::regex_replace(text, std::regex(from), to);
      return text;
    }

    /// What is wrong with a line that deal.II has that problem with; empty if it says it
    /// best.
    std::string
    explanation(const Line &line, const std::string &problem, const ParameterHandler &prm)
    {
      const std::string where = line.path.empty() ?
                                  "outside subsections" :
                                  "in the subsection \"" + join(line.path, "/") + "\"";
      if (line.kind == Line::subsection)
        return "there is no subsection \"" + line.name + "\" " + where +
               "; there are: " + names_in(prm, line.path, Line::subsection) + ".";
      std::smatch value;
      if (line.kind == Line::set &&
          std::regex_search(problem,
                            value,
                            std::regex("does not match the given pattern: (.*)")))
        return "\"" + line.value + "\" is no value for \"" + line.name + "\" " + where +
               "; allowed: " + in_words(value[1]);
      if (line.kind == Line::set && problem.find("No entry") != std::string::npos)
        return "there is no parameter \"" + line.name + "\" " + where +
               "; there are: " + names_in(prm, line.path, Line::set) + ".";
      if (line.kind == Line::other &&
          problem.find("cannot be opened") == std::string::npos)
        return "\"" + line.name +
               "\" is neither \"set Name = value\", \"subsection Name\" nor the \"end\" "
               "of a subsection.";
      return "";
    }
  } // namespace

  ParameterFile::ParameterFile(const MPI_Comm                 &comm,
                               const std::string              &name,
                               const std::vector<std::string> &settings)
    : name(name)
  {
    std::string error;
    if (!name.empty() && Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          text = read_file(name);
        }
      catch (const UserError &e)
        {
          error = e.what();
        }
    throw_first(comm, error);
    text = Utilities::MPI::broadcast(comm, text);
    if (!text.empty() && text.back() != '\n')
      text += '\n';
    n_lines = n_file_lines = std::count(text.begin(), text.end(), '\n');

    check_closed();
    for (const std::string &setting : settings)
      append(setting);
    scan();
    if (name.empty())
      n_numbered = {{"Liquid", 1}, {"Solid", 1}, {"Emitter", 1}, {"Probe", 1}};
  }

  void
  ParameterFile::check_closed() const
  {
    std::vector<Line> open;
    for (const Line &line : parameter_lines(text))
      if (line.kind == Line::subsection)
        open.push_back(line);
      else if (line.kind == Line::end)
        open.pop_back();
    require(open.empty(),
            open.empty() ? "" :
                           place(open.back().first) + ": the subsection \"" +
                             open.back().name + "\" is not closed by \"end\".");
  }

  void
  ParameterFile::append(const std::string &setting)
  {
    const auto equals = setting.find('=');
    require(equals != std::string::npos &&
              setting.find_first_of("\n\\#") == std::string::npos,
            "--set '" + setting + "' must have the form 'Section/Name=value'.");
    std::vector<std::string> path =
      Utilities::split_string_list(setting.substr(0, equals), '/');
    const std::string entry = path.empty() ? "" : path.back();
    require(!entry.empty(),
            "--set '" + setting + "' must have the form 'Section/Name=value'.");
    path.pop_back();
    for (const std::string &section : path)
      text += "subsection " + section + '\n';
    text += "set " + entry + " = " + setting.substr(equals + 1) + '\n';
    for (unsigned int i = 0; i < path.size(); ++i)
      text += "end\n";
    n_lines += 2 * path.size() + 1;
    setting_at[n_lines] = setting;
  }

  void
  ParameterFile::scan()
  {
    std::map<std::string, std::map<unsigned int, unsigned int>>
                     lines; // by name and number
    const std::regex numbered("(Liquid|Solid|Emitter|Probe) ([0-9]{1,6})");
    std::smatch      match;
    for (const Line &line : parameter_lines(text))
      if (!line.path.empty())
        continue;
      else if (line.kind == Line::set && line.name == "Dimension")
        {
          require(line.value == "2" || line.value == "3",
                  place(line.first) + ": Dimension is \"" + line.value +
                    "\", but must be 2 or 3.");
          dim = std::stoul(line.value);
        }
      else if (line.kind == Line::subsection &&
               std::regex_match(line.name, match, numbered))
        lines[match[1]][std::stoul(match[2])] = line.first;

    for (const auto &[name, line_of] : lines)
      for (const auto &[number, line] : line_of)
        {
          const unsigned int expected = ++n_numbered[name];
          const std::string  missing =
            number == 0 ? "" : "no \"" + name + " " + std::to_string(expected) + "\"; ";
          require(number == expected,
                  place(line) + ": there is a \"" + name + " " + std::to_string(number) +
                    "\", but " + missing +
                    "these subsections must be numbered 1, 2, ... without a gap.");
        }
  }

  std::string
  ParameterFile::place(const unsigned int line) const
  {
    if (line <= n_file_lines)
      return name + ", line " + std::to_string(line);
    return "--set '" + setting_at.lower_bound(line)->second + "'";
  }

  void
  ParameterFile::parse(ParameterHandler &prm) const
  {
    std::istringstream stream(text);
    try
      {
        prm.parse_input(stream, name);
      }
    catch (const ExceptionBase &exception)
      {
        std::ostringstream message;
        exception.print_info(message);
        explain(std::regex_replace(Utilities::trim(message.str()),
                                   std::regex("\\s+"),
                                   " "),
                prm);
      }
  }

  /// From deal.II's message, which gives the line and little else.
  void
  ParameterFile::explain(const std::string &message, const ParameterHandler &prm) const
  {
    std::smatch match;
    if (!std::regex_match(message, match, std::regex("Line <([0-9]+)> of file <(.*)")) ||
        match[2].str().compare(0, name.size(), name) != 0) // an included file
      throw UserError(name + ": " + message);
    const unsigned int number = std::stoul(match[1]);
    const std::string  problem =
      std::regex_replace(match[2].str().substr(name.size()), std::regex("^>?:? "), "");
    for (const Line &line : parameter_lines(text))
      if (line.first <= number && number <= line.last)
        if (const std::string sentence = explanation(line, problem, prm);
            !sentence.empty())
          throw UserError(place(number) + ": " + sentence);
    throw UserError(place(number) + ": " + problem);
  }
} // namespace treacle
