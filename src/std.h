#pragma once
// The names of the standard library that the program uses everywhere, without `std::`. All other names keep it, and so
// does abs, which C has for int alone. A file that includes this one does not repeat its headers.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

using std::array;
using std::ceil;
using std::clamp;
using std::exchange;
using std::floor;
using std::function;
using std::hypot;
using std::int16_t;
using std::int32_t;
using std::int64_t;
using std::int8_t;
using std::isfinite;
using std::log;
using std::make_shared;
using std::make_unique;
using std::map;
using std::max;
using std::min;
using std::nullopt;
using std::numeric_limits;
using std::optional;
using std::pair;
using std::pow;
using std::ptrdiff_t;
using std::runtime_error;
using std::set;
using std::shared_ptr;
using std::size_t;
using std::span;
using std::sqrt;
using std::string;
using std::string_view;
using std::tie;
using std::to_string;
using std::uint16_t;
using std::uint32_t;
using std::uint64_t;
using std::uint8_t;
using std::unique_ptr;
using std::vector;
using std::ranges::all_of;
using std::ranges::any_of;
using std::ranges::none_of;
namespace ranges = std::ranges;

inline constexpr double infinity = numeric_limits<double>::infinity();

/// std::ranges::contains of C++23.
template <ranges::input_range Range, class Value>
constexpr bool contains(const Range& range, const Value& value) {
  return ranges::find(range, value) != ranges::end(range);
}

}  // namespace carom
