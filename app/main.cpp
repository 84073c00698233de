// SPDX-License-Identifier: MIT
#include "app/command_line.h"
#include "tracer/base/freed_memory.h"

int main(int argument_count, char** arguments) {
  tracer::keep_freed_memory();
  return app::run_command_line({arguments + 1, arguments + argument_count});
}
