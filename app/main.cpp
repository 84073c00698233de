// SPDX-License-Identifier: MIT
#include "app/command_line.h"

int main(int argument_count, char** arguments) {
  return app::run_command_line({arguments + 1, arguments + argument_count});
}
