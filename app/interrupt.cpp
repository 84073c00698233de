// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <atomic>
#include <cassert>

namespace app {
namespace {

// What the handler may touch: lock-free atomics only.
std::atomic<tracer::Progress*> loading_in_flight{nullptr};
std::atomic<tracer::StopFlag*> rendering_in_flight{nullptr};
std::atomic<bool> interrupted{false};
static_assert(std::atomic<tracer::Progress*>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free);

void handle_interrupt(int) {
  interrupted.store(true);
  if (tracer::Progress* loading = loading_in_flight.load()) loading->request_stop();
  if (tracer::StopFlag* rendering = rendering_in_flight.load()) rendering->request();
}

}  // namespace

InterruptGuard::InterruptGuard(tracer::Progress& loading, tracer::StopFlag& rendering) {
  assert(!loading_in_flight.load());
  interrupted.store(false);
  loading_in_flight.store(&loading);
  rendering_in_flight.store(&rendering);
  struct sigaction action {};
  action.sa_handler = handle_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, &previous_interrupt_);
  sigaction(SIGTERM, &action, &previous_terminate_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &previous_interrupt_, nullptr);
  sigaction(SIGTERM, &previous_terminate_, nullptr);
  loading_in_flight.store(nullptr);
  rendering_in_flight.store(nullptr);
}

bool InterruptGuard::was_interrupted() const {
  return interrupted.load();
}

}  // namespace app
