// One name, one type in the whole program. Two types of one name in one namespace break the one definition rule, and
// the linker reports nothing. In two namespaces they mislead readers.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "architecture/cpp_declarations.h"
#include "architecture/source_tree.h"

namespace carom::testing {
namespace {

/// Names shared by two types: classes, enums and aliases at namespace scope, in unnamed namespaces too. Equal aliases
/// are one type. Nested types and specializations do not count, and neither do .inc files, which are compiled several
/// times.
std::vector<std::string> shared_names(const std::vector<SourceFile>& files) {
  struct Use {
    std::string meaning;  // of an alias
    std::string places;
    bool shared = false;
  };
  std::map<std::string, Use> uses;
  for (const SourceFile& file : files) {
    if (file.path.ends_with(".inc")) {
      continue;
    }
    for (const TypeDefinition& type : declarations_of(file.text).types) {
      if (type.nested || type.is_specialization || type.name.empty()) {
        continue;
      }
      const auto [use, is_new] = uses.try_emplace(type.name, Use{type.meaning, "", false});
      const bool is_same_alias = !type.meaning.empty() && type.meaning == use->second.meaning;
      use->second.shared |= !is_new && !is_same_alias;
      use->second.places += " " + file.path + ":" + std::to_string(type.line);
    }
  }
  std::vector<std::string> found;
  for (const auto& [name, use] : uses) {
    if (use.shared) {
      found.push_back(name + " is in" + use.places);
    }
  }
  return found;
}

using Found = std::vector<std::string>;

TEST(TypeNames, OfTwoTypesAreFound) {
  EXPECT_EQ(shared_names({{"a.h", "namespace n { class C {}; }"}, {"b.h", "\nnamespace n { struct C {}; }"}}),
            Found{"C is in a.h:1 b.h:2"});
  EXPECT_EQ(shared_names({{"a.cpp", "namespace { enum class E { a }; }"}, {"b.cpp", "namespace { union E {}; }"}}),
            Found{"E is in a.cpp:1 b.cpp:1"});
  EXPECT_EQ(shared_names({{"a.h", "namespace n { class C final : B {}; }"}, {"b.cpp", "using C = int;"}}),
            Found{"C is in a.h:1 b.cpp:1"});
  EXPECT_EQ(shared_names({{"a.cpp", "using C = int;"}, {"b.cpp", "using C = int;"}, {"c.cpp", "using C = bool;"}}),
            Found{"C is in a.cpp:1 b.cpp:1 c.cpp:1"});
  EXPECT_EQ(shared_names({{"a.h", "template <typename T> class C {};"}, {"b.h", "typedef int C;"}}),
            Found{"C is in a.h:1 b.h:1"});
}

TEST(TypeNames, OfOneTypeAreNot) {
  EXPECT_EQ(
      shared_names({{"a.h", "class C; enum E : int; friend struct D;"}, {"b.h", "class C {}; enum E : int { a };"}}),
      Found{});
  EXPECT_EQ(shared_names({{"a.h", "class C { class D {}; using T = int; };"}, {"b.h", "class E { class D {}; };"}}),
            Found{});
  EXPECT_EQ(shared_names({{"a.h", "template <typename T> class C {}; template <> class C<int> {};"},
                          {"b.h", "struct C::Impl {}; struct E::Impl {};"}}),
            Found{});
  EXPECT_EQ(shared_names({{"a.cpp", "using Json = n::json;"}, {"b.cpp", "using Json = n::json; using n::json;"}}),
            Found{});
  EXPECT_EQ(shared_names({{"a.cpp", "void f() { struct C {}; } // class C {};"}, {"b.cpp", "class C {};"}}), Found{});
}

TEST(TypeNames, AreUniqueInTheProgram) {
  EXPECT_EQ(shared_names(program_files()), Found{});
}

}  // namespace
}  // namespace carom::testing
