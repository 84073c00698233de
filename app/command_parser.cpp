// SPDX-License-Identifier: MIT
#include "app/command_parser.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "app/option_error.h"

namespace app {
namespace {

// CLI11's help with the command's own usage lines.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) { column_width(34); }
  std::string make_usage(const CLI::App*, std::string) const override {
    return "\nUsage: " + usage_ + "\n";
  }
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    // CLI11 leaves two empty lines between groups.
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, name, mode), "\n\n\n",
                                         "\n\n");
  }

 private:
  std::string usage_;
};

// CLI11 takes "-.5" for an option; "-0.5" it knows for a number.
std::string with_leading_zero(const std::string& argument) {
  return argument.starts_with("-.") ? "-0" + argument.substr(1) : argument;
}

// The option that was given more often than it takes values; nullptr where there is none.
const CLI::Option* repeated_option(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (static_cast<int>(option->count()) > option->get_items_expected_max()) return option;
  }
  return nullptr;
}

}  // namespace

CommandParser::CommandParser(const std::string& name, const std::string& description,
                             const std::string& usage, const std::string& examples)
    : name_(name), app_(description) {
  app_.formatter(std::make_shared<HelpFormatter>(usage));
  app_.get_formatter()->label("Positionals", "Arguments");
  app_.get_formatter()->label("REQUIRED", "");
  app_.set_help_flag("-h,--help", "print this help");
  app_.footer("Examples:\n" + examples);
}

Parsed CommandParser::parse(const std::vector<std::string>& arguments) {
  // CLI11 takes them last first.
  std::vector<std::string> reversed(arguments.size());
  std::transform(arguments.rbegin(), arguments.rend(), reversed.begin(), with_leading_zero);
  try {
    app_.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app_.help());
    return Parsed::help_was_printed;
  } catch (const CLI::ParseError& error) {
    const CLI::Option* repeated = repeated_option(app_);
    const std::string what =
        repeated ? repeated->get_name() + ": given more than once" : std::string(error.what());
    throw OptionError(fmt::format("boxwood {}: {}; see boxwood {} --help", name_, what, name_));
  }
  return Parsed::run;
}

}  // namespace app
