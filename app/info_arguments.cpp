// SPDX-License-Identifier: MIT
#include "app/command_parser.h"
#include "app/commands.h"
#include "app/exit_code.h"
#include "app/info_command.h"
#include "app/option_values.h"

namespace app {

int run_info(const std::vector<std::string>& arguments) {
  CommandParser parser("info", "What is in an OBJ file, and what had to be left out.",
                       "boxwood info MODEL.obj [--json]",
                       "  boxwood info cow.obj\n"
                       "  boxwood info cow.obj --json");
  InfoOptions options;
  CLI::App& app = parser.options();
  add_path(app, "MODEL", "", "an OBJ file", [&](const auto& path) {
    options.model = path;
  })->required();
  app.add_flag_callback(
      "--json", [&] { options.format = InfoOptions::Format::json; },
      "print JSON, for other programs");
  if (parser.parse(arguments) == Parsed::help_was_printed) return exit_code::success;
  return info_command(options);
}

}  // namespace app
