// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"

#include "ExitCodes.h"
#include "ParameterRange.h"
#include "Version.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>

namespace silhouette::program
{
namespace
{

constexpr std::size_t NameColumn = 30;
constexpr std::size_t TextWidth = 74;

/** Break lines between words; breaks that are there stay. */
std::string wrapped(const std::string& text)
{
  std::string result;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line))
  {
    std::istringstream words(line);
    std::string word;
    std::size_t used = 0;
    result += result.empty() ? "" : "\n";
    while (words >> word)
    {
      if (used > 0 && used + 1 + word.size() > TextWidth)
      {
        result += "\n";
        used = 0;
      }
      result += (used > 0 ? " " : "") + word;
      used += (used > 0 ? 1 : 0) + word.size();
    }
  }
  return result;
}

std::optional<double> parseNumber(const std::string& text)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value))
  {
    return std::nullopt;
  }
  return value;
}

} // namespace

HelpFormatter::HelpFormatter()
{
  this->column_width(NameColumn);
  this->label("SUBCOMMAND", "COMMAND");
  this->label("Positionals", "What to work on");
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const
{
  if (option->get_type_size() == 0 || option->get_positional())
  {
    return {};
  }
  const std::string type = option->get_type_name();
  return " " + type.substr(0, type.find(":{")); // the choices are explained in the description
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const
{
  std::string text = option->get_description();
  if (option->get_type_size() != 0 && !option->get_default_str().empty())
  {
    text += " (default: " + option->get_default_str() + ")";
  }
  if (option->get_required() && !option->get_positional())
  {
    text += " (required)";
  }
  return wrapped(text);
}

std::string HelpFormatter::make_description(const CLI::App* app) const
{
  return app->get_description() + "\n\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const
{
  const std::string text = command->get_description();
  std::ostringstream line;
  CLI::detail::format_help(line, command->get_name(), text.substr(0, text.find('\n')), NameColumn);
  return line.str();
}

CLI::App* addCommand(CLI::App& program, const std::string& name, const std::string& description)
{
  CLI::App* command = program.add_subcommand(name, description);
  command->group("Commands");
  command->set_help_flag("-h,--help", "This text");
  command->set_version_flag("--version", ProgramVersion, "The program's version");
  return command;
}

CLI::Validator inRange(double least, double greatest, bool whole)
{
  const auto check = [=](std::string& text) -> std::string
  {
    const std::optional<double> value = parseNumber(text);
    if (value && *value >= least && *value <= greatest && (!whole || *value == std::floor(*value)))
    {
      return {};
    }
    return "'" + text + "' is not a " + (whole ? "whole " : "") + "number from " + numberText(least) + " to " +
      numberText(greatest);
  };
  return CLI::Validator(check, "");
}

CLI::Validator aboveZero(double greatest)
{
  const auto check = [=](std::string& text) -> std::string
  {
    const std::optional<double> value = parseNumber(text);
    if (value && *value > 0.0 && *value <= greatest)
    {
      return {};
    }
    return "'" + text + "' is not a number above 0" +
      (greatest < std::numeric_limits<double>::max() ? " and at most " + numberText(greatest) : "");
  };
  return CLI::Validator(check, "");
}

std::vector<double> parseNumbers(
  const std::string& option, const std::string& text, std::size_t count, const std::string& expected)
{
  std::vector<double> values;
  std::istringstream parts(text);
  std::string part;
  while (std::getline(parts, part, ','))
  {
    values.push_back(parseNumber(part).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  const bool finite = std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (values.size() != count || !finite || text.back() == ',')
  {
    throw CLI::ValidationError(option, "expected " + expected + "; got '" + text + "'");
  }
  return values;
}

int indexOf(const std::string& value, const std::vector<std::string>& names)
{
  return static_cast<int>(std::find(names.begin(), names.end(), value) - names.begin());
}

} // namespace silhouette::program
