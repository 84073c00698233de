// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace app {

enum class Parsed { run, help_was_printed };

/// The options of one command, `boxwood NAME`.
class CommandParser {
 public:
  /// `usage` and `examples` are printed as they are.
  CommandParser(const std::string& name, const std::string& description, const std::string& usage,
                const std::string& examples);

  CLI::App& options() { return app_; }

  /// Throws OptionError, one line.
  Parsed parse(const std::vector<std::string>& arguments);

 private:
  std::string name_;
  CLI::App app_;
};

}  // namespace app
