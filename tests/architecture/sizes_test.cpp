// Limits for readability: functions of at most 80 lines, types of at most 20 data members, and every class in
// one .h and one .cpp.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "architecture/cpp_declarations.h"
#include "architecture/source_tree.h"

namespace carom::testing {
namespace {

constexpr std::size_t most_lines = 80, most_members = 20;

std::string full_name(const FunctionDefinition& function) {
  return function.class_name.empty() ? function.name : function.class_name + "::" + function.name;
}

std::vector<std::string> long_functions(const std::vector<SourceFile>& files) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    for (const FunctionDefinition& function : declarations_of(file.text).functions) {
      if (function.lines > most_lines) {
        found.push_back(file.path + ": " + full_name(function) + " has " + std::to_string(function.lines) + " lines");
      }
    }
  }
  return found;
}

std::vector<std::string> large_types(const std::vector<SourceFile>& files) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    for (const TypeDefinition& type : declarations_of(file.text).types) {
      if (type.data_members > most_members) {
        found.push_back(file.path + ": " + type.name + " has " + std::to_string(type.data_members) + " data members");
      }
    }
  }
  return found;
}

/// Where a class is defined.
struct Home {
  std::string path;
  bool is_template = false;
};

/// Classes by name, those within others too.
std::map<std::string, Home> homes_of(const std::vector<SourceFile>& files) {
  std::map<std::string, Home> homes;
  for (const SourceFile& file : files) {
    for (const TypeDefinition& type : declarations_of(file.text).types) {
      homes[type.name] = {file.path, type.is_template};
    }
  }
  return homes;
}

/// The class that a function's qualified name means: "carom::Outer::Inner" is "Outer::Inner". Empty: none.
std::string class_of(const FunctionDefinition& function, const std::map<std::string, Home>& homes) {
  std::string name = function.class_name;
  while (!name.empty() && !homes.contains(name)) {
    const std::size_t next = name.find("::");
    name = next == std::string::npos ? "" : name.substr(next + 2);
  }
  return name;
}

/// Classes with functions in several files. Functions in the class itself, or inline in its header, count for no
/// file, except those of templates or in a .cpp.
std::vector<std::string> scattered_classes(const std::vector<SourceFile>& files) {
  const std::map<std::string, Home> homes = homes_of(files);
  std::map<std::string, std::set<std::string>> places;
  for (const SourceFile& file : files) {
    for (const FunctionDefinition& function : declarations_of(file.text).functions) {
      const std::string name = class_of(function, homes);
      if (name.empty()) {
        continue;
      }
      const bool at_home = file.path == homes.at(name).path && file.path.ends_with(".h");
      if (!at_home || (!function.inside && homes.at(name).is_template)) {
        places[name].insert(file.path);
      }
    }
  }
  std::vector<std::string> found;
  for (const auto& [name, paths] : places) {
    if (paths.size() > 1) {
      found.push_back(name + " is in");
      for (const std::string& path : paths) {
        found.back() += " " + path;
      }
    }
  }
  return found;
}

using Found = std::vector<std::string>;

std::string lines(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += "  f();\n";
  }
  return text;
}

std::string members(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += "  int m" + std::to_string(i) + " = 0;\n";
  }
  return text;
}

TEST(FunctionLength, IsFoundAboveTheLimitAlone) {
  EXPECT_EQ(long_functions({{"a.cpp", "void g() {\n" + lines(78) + "}\n"}}), Found{});
  EXPECT_EQ(long_functions({{"a.cpp", "int x;\nvoid g() {\n" + lines(79) + "}\n"}}), Found{"a.cpp: g has 81 lines"});
  EXPECT_EQ(long_functions({{"a.h", "class C {\n void g(int a,\n int b) {\n" + lines(90) + "}\n};"}}),
            Found{"a.h: C::g has 93 lines"});
  EXPECT_EQ(long_functions({{"a.cpp", "void g() {\n const auto h = [] {\n" + lines(80) + "};\n}\n"}}),
            Found{"a.cpp: g has 84 lines"});
}

TEST(FunctionLength, IsNotThatOfATableOrAClass) {
  EXPECT_EQ(long_functions({{"a.cpp", "const int table[] = {\n" + std::string(100, '\n') + "1};\n"}}), Found{});
  EXPECT_EQ(long_functions({{"a.h", "class C {\n" + members(100) + "};\n"}}), Found{});
}

TEST(DataMembers, AreFoundAboveTheLimitAlone) {
  EXPECT_EQ(large_types({{"a.h", "struct C {\n" + members(20) + "  static constexpr int a = 1;\n};"}}), Found{});
  EXPECT_EQ(large_types({{"a.h", "struct C {\n" + members(20) + "  void f();\n  bool a;\n};"}}),
            Found{"a.h: C has 21 data members"});
  EXPECT_EQ(large_types({{"a.cpp", "class C {\n struct D {\n" + members(30) + "};\n D d; };"}}),
            Found{"a.cpp: C::D has 30 data members"});
  EXPECT_EQ(large_types({{"a.cpp", "struct C {\n void f() {\n" + members(30) + "}\n" + members(20) + "};"}}), Found{});
}

TEST(OneFileAClass, IsHeldByAHeaderAndItsSource) {
  EXPECT_EQ(scattered_classes({{"c.h", "class C { void f() {} void g(); void h(); };\ninline void C::h() {}"},
                               {"c.cpp", "struct C::I { void f() {} };\nvoid C::g() {}"}}),
            Found{});
  EXPECT_EQ(scattered_classes({{"c.h",
                                "template <typename T> class C { void f() {} };\n"
                                "template <typename T> void C<T>::g() {}"}}),
            Found{});
  EXPECT_EQ(scattered_classes({{"c.cpp", "class C { void f() {} void g(); };\nvoid C::g() {}\nvoid d::f() {}"},
                               {"d.cpp", "void d::g() {}"}}),
            Found{});
}

TEST(OneFileAClass, IsNotHeldByTwoSources) {
  EXPECT_EQ(scattered_classes({{"c.h", "class C { void f(); void g(); };"},
                               {"c.cpp", "void C::f() {}"},
                               {"d.cpp", "namespace n { void n::C::g() {} }"}}),
            Found{"C is in c.cpp d.cpp"});
  EXPECT_EQ(scattered_classes({{"c.h", "class C { void f(); };"}, {"d.h", "void C::f() {}"}, {"e.cpp", "C::C() {}"}}),
            Found{"C is in d.h e.cpp"});
  EXPECT_EQ(scattered_classes({{"c.h", "template <typename T> class C {};\ntemplate <typename T> void C<T>::g() {}"},
                               {"c.inc", "template <typename T> void C<T>::h() {}"}}),
            Found{"C is in c.h c.inc"});
  EXPECT_EQ(scattered_classes(
                {{"c.cpp", "class C { struct D { void f(); void g() {} }; };"}, {"d.cpp", "void C::D::f() {}"}}),
            Found{"C::D is in c.cpp d.cpp"});
}

TEST(Sizes, NoFunctionHasMoreThan80Lines) {
  EXPECT_EQ(long_functions(program_files()), Found{});
}

TEST(Sizes, NoTypeHasMoreThan20DataMembers) {
  EXPECT_EQ(large_types(program_files()), Found{});
}

TEST(Sizes, NoClassIsDefinedInTwoSources) {
  EXPECT_EQ(scattered_classes(program_files()), Found{});
}

}  // namespace
}  // namespace carom::testing
