#include "architecture/cpp_declarations.h"

#include <map>
#include <set>

#include "architecture/cpp_tokens.h"

namespace carom::testing {
namespace {

/// The scope of a declaration.
struct Scope {
  std::string namespaces;
  std::string class_name;          // "" at namespace scope
  std::size_t* members = nullptr;  // of the class: those counted so far
};

/// The names before a function's parameters: "Outer::Inner::f" as {"Outer", "Inner", "f"}.
using QualifiedName = std::vector<std::string>;

std::string joined(const std::string& outer, const std::string& inner) {
  return outer.empty() || inner.empty() ? outer + inner : outer + "::" + inner;
}

/// Reads declarations in sequence. Functions that skip leave `at_` after the skipped tokens.
class Reader {
 public:
  explicit Reader(const std::string& text) : tokens_(tokens_of(text)) {}

  Declarations read() {
    read_scope({});
    found_.matched = found_.matched && at_ == tokens_.size();
    return std::move(found_);
  }

 private:
  /// The words before a declaration proper.
  struct Prefix {
    std::size_t begin = 0;  // the first token
    bool is_template = false;
    std::set<std::string> words;
  };

  bool ended() const { return at_ >= tokens_.size(); }
  const std::string& text(std::size_t offset = 0) const {
    static const std::string none;
    return at_ + offset < tokens_.size() ? tokens_[at_ + offset].text : none;
  }
  bool is(const char* what) const { return text() == what; }
  bool at_name(std::size_t offset = 0) const { return at_ + offset < tokens_.size() && is_name(tokens_[at_ + offset]); }

  /// Skips to after the matching closing bracket.
  void skip_brackets() {
    static const std::map<std::string, std::string> closing = {{"(", ")"}, {"[", "]"}, {"{", "}"}};
    std::vector<std::string> open;  // the closing brackets of those that are open
    do {
      if (const auto pair = closing.find(text()); pair != closing.end()) {
        open.push_back(pair->second);
      } else if (is(")") || is("]") || is("}")) {
        found_.matched = found_.matched && open.back() == text();
        open.pop_back();
      }
      ++at_;
    } while (!open.empty() && !ended());
    found_.matched = found_.matched && open.empty();
  }

  /// Template parameters or arguments, from their `<` on.
  void skip_angles() {
    std::size_t depth = 0;
    do {
      if (is("(") || is("[") || is("{")) {
        skip_brackets();
        continue;
      }
      depth += is("<");
      depth -= is(">");
      ++at_;
    } while (depth > 0 && !ended());
    found_.matched = found_.matched && depth == 0;
  }

  /// An initializer's `<` opens template arguments if only tokens allowed in them come before a `>`.
  bool opens_angles() const {
    static const std::set<std::string> inside = {"::", ",", "<", ">", "*", "&", "(", ")"};
    std::size_t depth = 0;
    for (std::size_t i = at_; i < tokens_.size(); ++i) {
      if (!is_name(tokens_[i]) && !inside.contains(tokens_[i].text)) {
        return false;
      }
      depth += tokens_[i].text == "<";
      depth -= tokens_[i].text == ">";
      if (depth == 0) {
        return true;
      }
    }
    return false;
  }

  /// Skips to the `,` or `;` that ends it.
  void skip_initializer() {
    while (!ended() && !is(",") && !is(";") && !is("}")) {
      if (is("(") || is("[") || is("{")) {
        skip_brackets();
      } else if (is("<") && opens_angles()) {
        skip_angles();
      } else {
        ++at_;
      }
    }
  }

  /// Skips to after the next `;`.
  void skip_statement() {
    for (skip_initializer(); is(","); skip_initializer()) {
      ++at_;
    }
    if (is(";")) {
      ++at_;
    }
  }

  /// `std::vector<T>::size_type`
  void skip_qualified_name() {
    do {
      at_ += is("::");
      ++at_;
      if (is("<")) {
        skip_angles();
      }
    } while (is("::"));
  }

  /// A constraint: names, their arguments and parentheses, joined by && and |.
  void skip_requires() {
    ++at_;
    do {
      while (is("&&") || is("|") || is("!")) {
        ++at_;
      }
      if (is("(")) {
        skip_brackets();
      } else {
        skip_qualified_name();
      }
    } while (is("&&") || is("|"));
  }

  void read_scope(const Scope& scope) {
    while (!ended() && !is("}")) {
      const std::size_t before = at_;
      read_declaration(scope);
      if (at_ == before) {  // not understood
        found_.matched = false;
        ++at_;
      }
    }
  }

  /// `{ ... }`
  void read_braced_scope(const Scope& scope) {
    ++at_;
    read_scope(scope);
    found_.matched = found_.matched && is("}");
    ++at_;
  }

  void read_declaration(const Scope& scope) {
    static const std::set<std::string> accesses = {"public", "private", "protected"};
    if (is(";")) {
      ++at_;
      return;
    }
    if (accesses.contains(text()) && text(1) == ":") {
      at_ += 2;
      return;
    }
    const Prefix prefix = read_prefix();
    if (prefix.words.contains("extern") && is("\"\"")) {
      ++at_;
      if (is("{")) {
        read_braced_scope(scope);
      }  // else a single declaration comes
    } else if (is("namespace")) {
      read_namespace(scope);
    } else if (is("using")) {
      read_using(scope, prefix);
    } else if (is("typedef")) {
      read_typedef(scope);
    } else if (is("static_assert") || is("concept")) {
      skip_statement();
    } else if (!read_type(scope, prefix)) {
      read_variable_or_function(scope, prefix);
    }
  }

  Prefix read_prefix() {
    static const std::set<std::string> words = {"inline",    "static",    "constexpr",   "extern",  "friend",
                                                "virtual",   "explicit",  "const",       "mutable", "volatile",
                                                "consteval", "constinit", "thread_local"};
    Prefix prefix;
    prefix.begin = at_;
    while (true) {
      if (is("template")) {
        ++at_;
        prefix.is_template = text(1) != ">";
        if (is("<")) {
          skip_angles();
        }
      } else if (is("requires")) {
        skip_requires();
      } else if (is("[") && text(1) == "[") {
        skip_brackets();
      } else if (text().starts_with("CAROM_")) {  // a macro of this program, without parameters
        prefix.begin += prefix.begin == at_;
        ++at_;
      } else if (is("alignas") || is("__attribute__")) {
        ++at_;
        skip_brackets();
      } else if (words.contains(text())) {
        prefix.words.insert(text());
        ++at_;
        if (is("(")) {  // explicit (...)
          skip_brackets();
        }
      } else {
        return prefix;
      }
    }
  }

  void read_namespace(Scope scope) {
    ++at_;
    std::string name;
    for (; !ended() && !is("{") && !is("=") && !is(";"); ++at_) {
      name += text();
    }
    if (is("{")) {
      scope.namespaces = joined(scope.namespaces, name.empty() ? "(anonymous)" : name);
      read_braced_scope(scope);
    } else {
      skip_statement();
    }
  }

  /// Its meaning goes from `begin` to here.
  void add_alias(const Scope& scope, const std::string& name, bool is_template, std::size_t begin) {
    TypeDefinition alias;
    for (std::size_t i = begin; i < at_ && i < tokens_.size(); ++i) {
      alias.meaning += tokens_[i].text;
    }
    alias.name = joined(scope.class_name, name);
    alias.scope = scope.namespaces;
    alias.nested = !scope.class_name.empty();
    alias.is_template = is_template;
    alias.line = tokens_[begin].line;
    found_.types.push_back(alias);
  }

  void read_using(const Scope& scope, const Prefix& prefix) {
    ++at_;
    const std::string name = text();
    const std::size_t begin = at_;
    const bool is_alias = text(1) == "=" || text(1) == "[";
    skip_statement();
    if (is_alias) {
      add_alias(scope, name, prefix.is_template, begin);
    }
  }

  /// The new name is in `(*name)`, or the last one.
  void read_typedef(const Scope& scope) {
    ++at_;
    std::string name;
    bool in_parentheses = false;
    const std::size_t begin = at_;
    for (; !ended() && !is(";"); ++at_) {
      if (is("{")) {
        skip_brackets();
      }
      if (is("(") && text(1) == "*" && at_name(2)) {
        name = text(2);
        in_parentheses = true;
      } else if (at_name() && !in_parentheses) {
        name = text();
      }
    }
    ++at_;
    add_alias(scope, name, false, begin);
  }

  /// Whether a type is defined or declared here. If not, `at_` stays.
  bool read_type(const Scope& scope, const Prefix& prefix) {
    const std::size_t begin = at_;
    const bool is_enum = is("enum");
    if (!is_enum && !is("class") && !is("struct") && !is("union")) {
      return false;
    }
    ++at_;
    if (is_enum && (is("class") || is("struct"))) {
      ++at_;
    }
    while (is("alignas") || is("[")) {
      at_ += is("alignas");
      skip_brackets();
    }
    TypeDefinition type;
    type.scope = scope.namespaces;
    type.line = tokens_[prefix.begin].line;
    type.is_template = prefix.is_template;
    std::string name;
    while (at_name() && !is("final")) {
      name += text();
      ++at_;
      if (is("<")) {
        type.is_specialization = true;
        skip_angles();
      }
      if (!is("::")) {
        break;
      }
      name += text();
      ++at_;
    }
    if (is("final")) {
      ++at_;
    }
    if (is(";")) {  // declared
      ++at_;
      return true;
    }
    if (is(":")) {
      skip_bases();
    }
    if (!is("{")) {  // `struct stat status;`
      at_ = begin;
      return false;
    }
    type.nested = !scope.class_name.empty() || name.find("::") != std::string::npos;
    type.name = joined(scope.class_name, name);
    read_type_body(scope, prefix, type, is_enum);
    return true;
  }

  void skip_bases() {
    while (!ended() && !is("{") && !is(";")) {
      if (is("<")) {
        skip_angles();
      } else {
        ++at_;
      }
    }
  }

  /// From the `{` on, with the variables that may be declared behind.
  void read_type_body(const Scope& scope, const Prefix& prefix, TypeDefinition type, bool is_enum) {
    const bool unnamed = type.name == scope.class_name;
    if (is_enum) {
      skip_brackets();
    } else {
      Scope inner = scope;
      inner.class_name = unnamed ? joined(scope.class_name, "(unnamed)") : type.name;
      inner.members = &type.data_members;
      read_braced_scope(inner);
    }
    if (scope.members && unnamed) {
      *scope.members += type.data_members;
    } else if (scope.members && !is(";") && counts(prefix)) {
      *scope.members += count_declarators();
    }
    skip_statement();
    if (!unnamed || !scope.members) {
      found_.types.push_back(type);
    }
  }

  static bool counts(const Prefix& prefix) {
    const bool fixed = prefix.words.contains("constexpr") || prefix.words.contains("const");
    return !prefix.words.contains("friend") && !(prefix.words.contains("static") && fixed);
  }

  /// Up to the `;`.
  std::size_t count_declarators() {
    std::size_t count = 1;
    for (; !ended() && !is(";") && !is("}"); ++at_) {
      skip_initializer();
      if (!is(",")) {
        break;
      }
      ++count;
    }
    return count;
  }

  /// Both begin alike; a function has parameters.
  void read_variable_or_function(const Scope& scope, const Prefix& prefix) {
    QualifiedName name;
    while (!ended() && !is("}")) {
      if (is("decltype")) {
        ++at_;
        skip_brackets();
      } else if (at_name() || is("~")) {
        const bool qualified = at_ > 0 && tokens_[at_ - 1].text == "::";
        if (!qualified) {
          name.clear();
        }
        name.push_back(read_name());
      } else if (is("<")) {
        skip_angles();
      } else if (is("(") && (text(1) == "*" || text(1) == "&")) {  // a pointer to a function
        read_variables(scope, prefix);
        return;
      } else if (is("(")) {
        skip_brackets();
        read_behind_parameters(scope, prefix, name);
        return;
      } else if (is("=") || is("{") || is("[") || is(",") || is(":") || is(";")) {
        read_variables(scope, prefix);
        return;
      } else {
        ++at_;  // :: * & ...
      }
    }
  }

  /// "f", "~Queue", "operator+"
  std::string read_name() {
    std::string name = text();
    ++at_;
    if (name == "~") {
      name += text();
      ++at_;
    } else if (name == "operator") {
      do {
        name += text();
        ++at_;
      } while (!ended() && (!is("(") || name == "operator("));
    }
    return name;
  }

  void read_variables(const Scope& scope, const Prefix& prefix) {
    const std::size_t count = count_declarators();
    if (scope.members && counts(prefix)) {
      *scope.members += count;
    }
    if (is(";")) {
      ++at_;
    }
  }

  void read_behind_parameters(const Scope& scope, const Prefix& prefix, const QualifiedName& name) {
    while (!ended() && !is("{") && !is(";") && !is("=") && !is(":") && !is("}")) {
      if (is("(") || is("[")) {
        skip_brackets();
      } else if (is("<")) {
        skip_angles();
      } else if (is("requires")) {
        skip_requires();
      } else {
        ++at_;
      }
    }
    if (is(":")) {
      skip_member_initializers();
    }
    if (!is("{")) {  // declared, defaulted, deleted
      skip_statement();
      return;
    }
    FunctionDefinition function;
    function.name = name.empty() ? "" : name.back();
    std::string class_name = scope.class_name;
    for (std::size_t i = 0; i + 1 < name.size(); ++i) {
      class_name = joined(class_name, name[i]);
    }
    function.class_name = class_name;
    function.inside = !scope.class_name.empty();
    function.is_template = prefix.is_template;
    function.line = tokens_[prefix.begin].line;
    skip_brackets();
    function.lines = tokens_[at_ - 1].line - function.line + 1;
    found_.functions.push_back(function);
  }

  /// `: a(1), b{2}`, up to the body.
  void skip_member_initializers() {
    do {
      ++at_;
      skip_qualified_name();
      if (is("(") || is("{")) {
        skip_brackets();
      }
      while (is(".")) {  // a pack
        ++at_;
      }
    } while (is(","));
  }

  const std::vector<Token> tokens_;
  std::size_t at_ = 0;
  Declarations found_;
};

}  // namespace

Declarations declarations_of(const std::string& text) {
  return Reader(text).read();
}

}  // namespace carom::testing
