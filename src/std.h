#pragma once
// The names of the standard library that the program uses everywhere, without `std::`. All other names keep it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

using std::array;
using std::clamp;
using std::function;
using std::int16_t;
using std::int32_t;
using std::int64_t;
using std::int8_t;
using std::make_shared;
using std::make_unique;
using std::max;
using std::min;
using std::nullopt;
using std::numeric_limits;
using std::optional;
using std::ptrdiff_t;
using std::shared_ptr;
using std::size_t;
using std::span;
using std::string;
using std::string_view;
using std::uint16_t;
using std::uint32_t;
using std::uint64_t;
using std::uint8_t;
using std::unique_ptr;
using std::vector;

}  // namespace carom
