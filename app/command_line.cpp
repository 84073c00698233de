// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/exit_code.h"
#include "app/option_error.h"
#include "tracer/base/error.h"

namespace app {
namespace {

constexpr const char* help_text =
    R"(Boxwood {}: traces rays through any OBJ, and shows its bounding volume hierarchy at work.

  boxwood [view] [MODEL.obj]                  open the window
  boxwood render MODEL.obj -o PICTURE.png     render to a .png, .exr or .pfm
  boxwood info MODEL.obj [options]            what is in the file, how good its trees are
  boxwood COMMAND --help                      all options of a command
  boxwood --version

Examples:
  boxwood cow.obj
  boxwood render cow.obj -o cow.png --spp 256 --size 1920x1080
  boxwood render cow.obj -o cow.exr --time 30 --integrator path --sky 0.8,0.9,1
  boxwood render cow.obj -o cow.pfm --bvh off --stats cow.json

Exit codes: 0 done, 1 failed, 2 bad options or files, 3 no display, 130 interrupted.
)";

int print(const std::string& text) {
  fmt::print("{}", text);
  return exit_code::success;
}

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return run_view(arguments);
  const std::string& first = arguments.front();
  if (first == "--help" || first == "-h") {
    return print(fmt::format(fmt::runtime(help_text), BOXWOOD_VERSION));
  }
  if (first == "--version") return print("boxwood " BOXWOOD_VERSION "\n");
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (first == "render") return run_render(rest);
  if (first == "info") return run_info(rest);
  return run_view(first == "view" ? rest : arguments);
}

// "a\nb\n" -> "a b": one line, whatever the message.
int fail(std::string text, int code) {
  while (text.ends_with('\n')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  fmt::print(stderr, "{}\n", text);
  return code;
}

// What was printed must have arrived: a full disk shows only here.
int finish(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  const char* why = errno != 0 ? std::strerror(errno) : "writing failed";
  return fail(std::string("boxwood: standard output cannot be written: ") + why,
              exit_code::failure);
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  try {
    return finish(dispatch(arguments));
  } catch (const OptionError& error) {
    return fail(error.what(), exit_code::bad_input);
  } catch (const tracer::LoadError& error) {
    return fail(error.what(), exit_code::bad_input);
  } catch (const std::bad_alloc&) {
    return fail("boxwood: there is not enough memory for this", exit_code::failure);
  } catch (const std::exception& error) {
    return fail(std::string("boxwood: ") + error.what(), exit_code::failure);
  }
}

}  // namespace app
