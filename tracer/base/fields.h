// SPDX-License-Identifier: MIT
// A settings struct lists its fields once, in for_each_field(settings, f); panels, command line and
// tests are lambdas over that list.
#pragma once

#include <span>
#include <string_view>
#include <type_traits>

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

/// One value of a setting that is a choice, as a table lists it.
template <class T>
struct Choice {
  T value;
  std::string_view name;   // as on the command line
  std::string_view label;  // as in the panel
  std::string_view what;   // one sentence
};

template <class T>
requires std::is_enum_v<T>
struct Field<T> {
  const char* name;
  std::span<const Choice<T>> choices;  // each value of T once
  const char* help;
  Effect effect;
};

/// The entry of `value`.
template <class T>
const Choice<T>& choice_of(T value, const Field<T>& field) {
  for (const Choice<T>& choice : field.choices) {
    if (choice.value == value) return choice;
  }
  return field.choices.front();
}

/// What stands for a field's value on the command line: the name of a choice, or the number.
template <class T>
auto option_value(const T& value, const Field<T>& field) {
  if constexpr (std::is_enum_v<T>) {
    return choice_of(value, field).name;
  } else {
    return value;
  }
}

}  // namespace tracer
