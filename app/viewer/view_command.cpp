// SPDX-License-Identifier: MIT
#include "app/viewer/view_command.h"

#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "app/exit_code.h"
#include "app/viewer/viewer.h"
#include "app/viewer/window.h"
#include "tracer/base/parallel.h"

namespace app {

int view_command(const ViewOptions& options) {
  const int thread_count =
      options.thread_count > 0 ? options.thread_count : tracer::default_thread_count();
  try {
    return tracer::with_thread_count(thread_count, [&] { return Viewer(options).run(); });
  } catch (const WindowError& error) {
    fmt::print(stderr, "boxwood: {}\n", error.what());
    return exit_code::no_display;
  } catch (const std::exception& exception) {
    fmt::print(stderr, "boxwood: {}\n", exception.what());
    return exit_code::bad_input;
  }
}

}  // namespace app
