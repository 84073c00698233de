// SPDX-License-Identifier: MIT
#include "app/background_thread.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace app {

void give_way_to_window() {
#ifdef __linux__
  // On Linux each thread has a niceness of its own, and new ones inherit it.
  constexpr int niceness = 10;
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
#endif
}

}  // namespace app
