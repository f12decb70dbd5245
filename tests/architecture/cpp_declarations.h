#pragma once
// The types and functions that a C++ file defines, read from its tokens, without name lookup or types.
// It reads what clang-format leaves and this program uses. What functions hold (lambdas, local types) is not read.
#include <cstddef>
#include <string>
#include <vector>

namespace carom::testing {

/// A class, struct, union, enum or alias, defined at namespace scope or in a class.
struct TypeDefinition {
  std::string name;     // with the classes around it: "Outer::Inner"; "" without a name
  std::string scope;    // the namespaces around it: "carom::(anonymous)"
  bool nested = false;  // in a class
  bool is_template = false;
  bool is_specialization = false;
  std::string meaning;  // of an alias: its tokens, "Json=nlohmann::json;"
  std::size_t line = 0;
  // Members of each object, and static ones that may change. Members of unnamed structs within count. Members of bases
  // and of named types within do not.
  std::size_t data_members = 0;
};

/// A function with its body.
struct FunctionDefinition {
  std::string name;        // without its class: "operator()", "~Queue"
  std::string class_name;  // with the classes around it; "" outside of classes
  bool inside = false;     // defined within its class
  bool is_template = false;
  std::size_t line = 0;   // of its first token
  std::size_t lines = 0;  // from there to the brace that closes it
};

struct Declarations {
  std::vector<TypeDefinition> types;
  std::vector<FunctionDefinition> functions;
  bool matched = true;  // every brace and parenthesis is matched
};

Declarations declarations_of(const std::string& text);

}  // namespace carom::testing
