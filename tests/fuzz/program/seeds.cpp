// carom_fuzz_seeds: the targets' names, a line each. carom_fuzz_seeds FOLDER: each target's first inputs, in a folder
// of its name, the longest input beside it (TARGET.longest), and the dictionary, words.dict.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "fuzz/targets.h"
#include "std.h"

using namespace carom::fuzz;

int main(int count, char** arguments) {
  if (count < 2) {
    for (const Target& target : targets()) std::puts(target.name);
    return 0;
  }

  const std::filesystem::path folder = arguments[1];
  for (const Target& target : targets()) {
    std::filesystem::create_directories(folder / target.name);
    int number = 0;
    for (const std::string& seed : target.seeds())
      std::ofstream(folder / target.name / ("seed" + std::to_string(number++)), std::ios::binary) << seed;
    std::ofstream(folder / (std::string(target.name) + ".longest")) << target.longest << "\n";
  }

  std::ofstream dictionary(folder / "words.dict");
  for (const std::string& word : words()) {
    dictionary << '"';
    for (const unsigned char c : word) {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02X", c);
      dictionary << code;
    }
    dictionary << "\"\n";
  }
  return dictionary.flush() ? 0 : 1;
}
