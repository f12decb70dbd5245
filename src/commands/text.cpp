// Rounds and groups digits for reading. Lines break by columns of the terminal and not by bytes.
#include "commands/text.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/letters.h"

namespace carom {

string quantity(double value, string_view unit) {
  if (std::isnan(value)) return "-";
  return fmt::format("{:.4g} {}", value == 0 ? 0.0 : value, unit);
}

string grouped(uint64_t count) {
  string digits = to_string(count);
  for (size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

string counted(uint64_t count, string_view singular, string_view plural) {
  return fmt::format("{} {}", grouped(count), count == 1 ? singular : plural);
}

string bytes_text(uint64_t bytes) {
  if (bytes < 1000) return counted(bytes, "byte", "bytes");
  constexpr array units = {"kB", "MB", "GB", "TB", "PB", "EB"};
  double value = double(bytes) / 1000;
  size_t unit = 0;
  while (value >= 999.5 && unit + 1 < units.size()) value /= 1000, ++unit;
  return fmt::format(fmt::runtime(value < 9.95 ? "{:.1f} {}" : "{:.0f} {}"), value, units[unit]);
}

string wait_text(double seconds) {
  if (!isfinite(seconds) || seconds < 0) return "-";
  if (seconds < 0.00995) return fmt::format("{:.1f} ms", seconds * 1000);
  if (seconds < 0.9995) return fmt::format("{:.0f} ms", seconds * 1000);
  if (seconds < 9.995) return fmt::format("{:.2f} s", seconds);
  const auto whole = uint64_t(min(std::round(seconds), 1e15));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

string listed(const vector<string>& names, size_t most) {
  const size_t shown = names.size() <= most ? names.size() : most;
  string text;
  for (size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  if (shown < names.size()) text += fmt::format(" and {} more", grouped(names.size() - shown));
  return text;
}

string wrapped(string_view text, size_t indent, size_t width) {
  string result;
  // The caller writes the beginning of the first line.
  size_t column = indent;

  while (!text.empty()) {
    const size_t end = min(text.find(' '), text.size());
    const string_view word = text.substr(0, end);
    const size_t length = letters_of(word);
    if (column > indent && column + 1 + length > width) {
      result += '\n' + string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }

    result += word;
    column += length;
    text.remove_prefix(min(end + 1, text.size()));
  }
  return result;
}

string shell_word(const string& word) {
  if (printable(word) != word) {
    // In octal, so that the word can be read and copied.
    string octal;
    for (const char c : word) octal += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    return "\"$(printf '" + octal + "')\"";
  }

  const bool plain = !word.empty() && all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           string_view("_-./=,:@%+").find(c) != string_view::npos;
  });
  if (plain) return word;
  string out = "'";
  for (const char c : word) out += c == '\'' ? string("'\\''") : string(1, c);
  return out + "'";
}

}  // namespace carom
