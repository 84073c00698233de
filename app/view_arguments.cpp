// SPDX-License-Identifier: MIT
#include "app/commands.h"
#include "app/exit_code.h"

#ifdef BOXWOOD_VIEWER
#include "app/command_parser.h"
#include "app/option_values.h"
#include "app/viewer/view_command.h"
#else
#include <cstdio>

#include <fmt/format.h>
#endif

namespace app {

#ifdef BOXWOOD_VIEWER

int run_view(const std::vector<std::string>& arguments) {
  CommandParser parser("view", "Opens the window; press H in it for the keys.",
                       "boxwood [view] [MODEL.obj] [options]",
                       "  boxwood cow.obj\n"
                       "  boxwood view cow.obj --view front.json\n"
                       "  boxwood view cow.obj --frames 8 --screenshot window.png");
  ViewOptions options;
  CLI::App& app = parser.options();
  add_path(app, "MODEL", "", "an OBJ file; it can be opened from the window too",
           [&](const auto& path) { options.model = path; });
  add_path(app, "--view", "FILE.json", "a saved view [MODEL.view.json, if it is there]",
           [&](const auto& path) { options.view_file = path; });
  add_value(app, "--size", "WxH", "of the window in pixels",
            [&](const std::string& text) { options.size_px = parse_size_px(text); });
  add_value(app, "--spp", "N", "samples a pixel at most, to begin with [1024]",
            [&](const std::string& text) {
              options.sample_limit = parse_whole_number(text, 1, 1000000);
            });
  add_value(app, "--error", "E", "the picture is done when its error is at most this: relMSE",
            [&](const std::string& text) { options.error_limit = parse_number(text, 1e-9, 100); });
  add_value(app, "--threads", "N", "threads to work on [all]", [&](const std::string& text) {
    options.thread_count = parse_whole_number(text, 1, max_threads);
  });
  add_value(
      app, "--frames", "N", "close when the picture has N samples a pixel",
      [&](const std::string& text) { options.frames = parse_whole_number(text, 1, 1000000); });
  add_path(app, "--screenshot", "FILE.png", "write the last frame of --frames here",
           [&](const auto& path) { options.screenshot = path; })
      ->needs("--frames");
  add_environment(app, options.environment, "");
  // For tests: no group, so that the help does not show it.
  add_path(app, "--ui-layout", "FILE", "", [&](const auto& path) {
    options.ui_layout = path;
  })->group("");
  if (parser.parse(arguments) == Parsed::help_was_printed) return exit_code::success;
  return view_command(options);
}

#else

int run_view(const std::vector<std::string>&) {
  fmt::print(stderr,
             "boxwood view: this program was built without the window; "
             "use boxwood render MODEL.obj -o PICTURE.png\n");
  return exit_code::bad_input;
}

#endif

}  // namespace app
