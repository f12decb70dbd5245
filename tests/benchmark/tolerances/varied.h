#pragma once
// Variable constants of simulate/tolerances.h: CAROM_VARIED="exact.contact_gap=4" makes one of them four
// times as large for a whole run.
#include <cstdlib>

#include "std.h"

namespace carom {

/// The constants' names, in the file's order.
inline vector<string>& varied_names() {
  static vector<string> names;
  return names;
}

inline double varied_value(const string& name, double value) {
  varied_names().push_back(name);
  const char* const given = std::getenv("CAROM_VARIED");
  const string wanted = given != nullptr ? given : "";
  return wanted.starts_with(name + "=") ? value * std::stod(wanted.substr(name.size() + 1)) : value;
}

namespace exact_tolerance {
template <typename T>
T varied(const char* name, double value) {
  return static_cast<T>(varied_value(string("exact.") + name, value));
}
}  // namespace exact_tolerance

namespace stepped_tolerance {
template <typename T>
T varied(const char* name, double value) {
  return static_cast<T>(varied_value(string("stepped.") + name, value));
}
}  // namespace stepped_tolerance

// The simulators do not use these, so that they are not varied.
namespace accuracy_tolerance {
template <typename T>
T varied(const char*, T value) {
  return value;
}
}  // namespace accuracy_tolerance

}  // namespace carom
