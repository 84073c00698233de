// SPDX-License-Identifier: MIT
// A settings struct lists its fields once, in for_each_field(settings, f); panels, command line and
// tests are lambdas over that list.
#pragma once

namespace tracer {

/// What has to happen when a setting changes.
enum class Effect {
  develop,  // tone-map the film again, trace nothing
  restart,  // clear the film
  rebuild,  // a new tree, the same film: a tree never changes the picture
};

template <class T>
struct Field {
  const char* name;  // as on the command line, without the dashes
  T min;
  T max;
  const char* help;
  Effect effect;
  const char* unit = "";  // shown behind the value
};

}  // namespace tracer
