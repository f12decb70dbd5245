#include "architecture/cpp_tokens.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace carom::testing {
namespace {

bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Reads a text from its beginning to its end.
class Lexer {
 public:
  explicit Lexer(const std::string& text) : text_(text) {}

  std::vector<Token> tokens() {
    while (at_ < text_.size()) {
      if (!skip_blanks_and_comments()) {
        take_token();
      }
    }
    return std::move(tokens_);
  }

 private:
  bool ahead(std::string_view what) const { return text_.compare(at_, what.size(), what) == 0; }
  char now(std::size_t offset = 0) const { return at_ + offset < text_.size() ? text_[at_ + offset] : '\0'; }

  /// Advances to `end` and counts the lines.
  void go_to(std::size_t end) {
    end = std::min(end, text_.size());
    line_ += static_cast<std::size_t>(std::count(text_.begin() + at_, text_.begin() + end, '\n'));
    at_ = end;
  }

  /// Advances to after the next `what`.
  void go_past(const std::string& what) {
    const std::size_t found = text_.find(what, at_);
    go_to(found == std::string::npos ? found : found + what.size());
  }

  bool skip_blanks_and_comments() {
    if (ahead("//")) {
      go_to(text_.find('\n', at_));
    } else if (ahead("/*")) {
      at_ += 2;
      go_past("*/");
    } else if (now() == '#' && (tokens_.empty() || tokens_.back().line != line_)) {
      skip_directive();
    } else if (std::string_view(" \t\r\n\f\v").find(now()) != std::string_view::npos) {
      go_to(at_ + 1);
    } else {
      return false;
    }
    return true;
  }

  void skip_directive() {
    while (at_ < text_.size() && now() != '\n') {
      go_to(at_ + (now() == '\\' ? 2 : 1));
    }
  }

  void take_token() {
    const std::size_t line = line_;
    std::string text;
    if (begins_name(now())) {
      text = take_name();
    } else if (is_digit(now()) || (now() == '.' && is_digit(now(1)))) {
      text = take_number();
    } else {
      text = take_punctuator();
    }
    if (now() == '"' && std::string_view("u8 u U L R u8R uR UR LR").find(text) != std::string_view::npos) {
      text = take_string(text.ends_with('R'));
    } else if (text == "\"" || text == "'") {
      at_ -= 1;
      text = take_string(false);
    }
    tokens_.push_back({text, line});
  }

  std::string take_name() {
    const std::size_t begin = at_;
    while (begins_name(now()) || is_digit(now())) {
      ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }

  /// 1'000, 0x1p-3, 1e+5, 2.5f
  std::string take_number() {
    const std::size_t begin = at_;
    while (true) {
      const bool sign_follows = (now(1) == '+' || now(1) == '-');
      const bool exponent = std::string_view("eEpP").find(now()) != std::string_view::npos;
      if (now() != '\0' && exponent && sign_follows) {
        at_ += 2;
      } else if (begins_name(now()) || is_digit(now()) || now() == '.' || (now() == '\'' && begins_word(now(1)))) {
        ++at_;
      } else {
        return text_.substr(begin, at_ - begin);
      }
    }
  }
  static bool begins_word(char c) { return begins_name(c) || is_digit(c); }

  /// From the quote on.
  std::string take_string(bool raw) {
    const char quote = now();
    if (raw) {
      const std::size_t open = text_.find('(', at_);
      const std::string closing = ")" + text_.substr(at_ + 1, open - at_ - 1) + "\"";
      go_past(closing);
    } else {
      for (++at_; at_ < text_.size() && now() != quote;) {
        go_to(at_ + (now() == '\\' ? 2 : 1));
      }
      go_to(at_ + 1);
    }
    return std::string(2, quote);
  }

  std::string take_punctuator() {
    static constexpr std::array<std::string_view, 7> pairs = {"::", "->", "&&", "==", "!=", "<=", ">="};
    for (std::string_view pair : pairs) {
      if (ahead(pair)) {
        at_ += 2;
        return std::string(pair);
      }
    }
    return std::string(1, text_[at_++]);
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(const std::string& text) {
  return Lexer(text).tokens();
}

bool is_name(const Token& token) {
  return begins_name(token.text.front());
}

}  // namespace carom::testing
