// The largest number has five digits, and the smallest has two. Numbers below 1e-9 of the largest are taken for
// rounding noise, such as an energy of 1e-15 J beside 15 J, and determine nothing.
#include "workbook/number_look.h"

#include <fmt/format.h>

#include <charconv>

#include "std.h"

namespace carom {
namespace {

constexpr int shown = 5, shown_of_least = 2, noise = 9;  // digits
constexpr int most_digits = 8;                           // without a power of ten
constexpr int most_decimals = 9;

/// The decimals of the shortest text of a number.
int decimals_of(double number) {
  char text[32];
  const char* end = std::to_chars(text, text + sizeof text, number).ptr;
  const char* power = std::find(text, static_cast<char*>(text) + (end - text), 'e');
  const char* point = std::find(static_cast<const char*>(text), power, '.');
  int decimals = point == power ? 0 : int(power - point) - 1;
  if (power != end) {
    int exponent = 0;
    std::from_chars(power + (power[1] == '+' ? 2 : 1), end, exponent);
    decimals -= exponent;
  }
  return clamp(decimals, 0, most_decimals);
}

}  // namespace

void NumberLook::add(double number) {
  if (!isfinite(number)) return;
  any_ = true;
  negative_ = negative_ || number < 0;
  if (number == 0) return;
  const int decade = int(floor(std::log10(std::abs(number))));
  has_[size_t(clamp(decade - least_decade, 0, decades - 1))] = true;
  decimals_ = max(decimals_, decimals_of(number));
}

NumberLook::Form NumberLook::form() const {
  const auto last = std::find(has_.rbegin(), has_.rend(), true);
  if (last == has_.rend()) return {};

  // The decades of the largest number, and of the smallest that is not noise.
  const auto index = int(has_.rend() - last) - 1;
  int low = index;
  for (int k = max(0, index - noise); k < low; ++k)
    if (has_[size_t(k)]) low = k;
  const int top = index + least_decade;
  low += least_decade;

  Form form{false, max(shown - 1 - top, shown_of_least - 1 - low), max(top + 1, 1)};
  form.decimals = clamp(form.decimals, 0, decimals_);
  const bool whole = decimals_ == 0;
  form.power = whole ? top > noise : form.digits + form.decimals > most_digits || top < 1 - shown;
  if (form.power) form.decimals = shown - 1;
  return form;
}

string NumberLook::format() const {
  if (!any_) return "General";
  const Form form = this->form();
  const string decimals = form.decimals > 0 ? "." + string(size_t(form.decimals), '0') : "";
  if (form.power) return "0" + decimals + "E+00";
  return (form.digits > 4 ? "#,##0" : "0") + decimals;
}

string NumberLook::text(double number) const {
  if (!isfinite(number)) return {};
  const Form form = this->form();
  string text =
      form.power ? fmt::format("{:.{}e}", number, form.decimals) : fmt::format("{:.{}f}", number, form.decimals);
  // What is rounded to zero has no sign.
  if (text.find_first_of("123456789") == string::npos && text.front() == '-') text.erase(0, 1);
  return text;
}

size_t NumberLook::width() const {
  if (!any_) return 0;
  const Form form = this->form();
  const int before = form.power ? 1 : form.digits + (form.digits > 4 ? (form.digits - 1) / 3 : 0);
  const int after = form.decimals > 0 ? form.decimals + 1 : 0;
  return size_t(before + after + (form.power ? 5 : 0) + (negative_ ? 1 : 0));
}

}  // namespace carom
