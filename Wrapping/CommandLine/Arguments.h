// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the commands share in reading their arguments and in explaining them.
 */
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <array>
#include <string>
#include <vector>

namespace silhouette::program
{

/** Help of a page's width: long descriptions wrapped, defaults and what is required said in words. */
class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter();
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

/** A command with --help and --version as the program has them. */
CLI::App* addCommand(CLI::App& program, const std::string& name, const std::string& description);

/** A number from `least` to `greatest`, both allowed; a whole one if `whole`. */
CLI::Validator inRange(double least, double greatest, bool whole = false);
/** A number above 0, up to `greatest`. */
CLI::Validator aboveZero(double greatest);

/** Numbers with commas between them. Throws CLI::ValidationError that names `option` and says `expected`. */
std::vector<double> parseNumbers(
  const std::string& option, const std::string& text, std::size_t count, const std::string& expected);

/** Where `value` stands in `names`; CLI has checked that it does. */
int indexOf(const std::string& value, const std::vector<std::string>& names);

} // namespace silhouette::program
