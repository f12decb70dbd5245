#include "fuzz/targets.h"

#include "scene/fields.h"
#include "std.h"

namespace carom::fuzz {

span<const Target> targets() {
  static const Target all[] = {
      {"scene", load_scene_bytes, scene_seeds, 4096},
      {"sweep", load_sweep_bytes, sweep_seeds, 2048},
      {"settings", apply_settings_bytes, settings_seeds, 512},

      {"mesh_reply", read_mesh_reply_bytes, mesh_reply_seeds, 1024},
      {"mesh", read_mesh_bytes, mesh_seeds, 2048, 200},  // its reader is a process
      {"flights", read_flights_bytes, flights_seeds, 2048},
      {"manifest", read_manifest_bytes, manifest_seeds, 2048},
      {"table", read_table_bytes, table_seeds, 16384},
      {"gzip", read_gzip_bytes, gzip_seeds, 4096},
      {"simulators", simulate_bytes, simulator_seeds, 1024, 200},  // milliseconds each
  };
  return all;
}

const Target* find_target(string_view name) {
  for (const Target& target : targets())
    if (target.name == name) return &target;
  return nullptr;
}

vector<string> words() {
  set<string> all = {"[0, 0, 0]", "[1e3, -2, .5]", "{",         "}",           "[",   "]",    ": ",  "- ",
                     "\n  ",      "1e308",         "-0",        "0x10",        "~",   "yes",  "off", "&a",
                     "*a",        "!!x",           "|",         ">",           "# ",  "\"",   "'",   ",",
                     "<<",        "...",           "\n---",     "null",        "nan", ".inf", "= ",  "'= i * r'",
                     "= sin(",    "{i}",           "repeat: 3", "let: {r: 1}", "none"};

  for (const span<const Kind>& family : families())
    for (const Kind& kind : family)
      for (const Field& field : kind.fields) {
        all.insert(string(field.key) + ": ");
        for (const string_view choice : choices(field)) all.emplace(choice);
        if (!field.example.empty()) all.emplace(field.example);
      }
  all.erase("");
  return {all.begin(), all.end()};
}

}  // namespace carom::fuzz
