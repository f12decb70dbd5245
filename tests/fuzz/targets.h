#pragma once
// Fuzz targets: functions of arbitrary bytes. Each passes the bytes to a part of the program as the content of a file,
// and checks the result against the guarantees of that part. A refusal by the part's own error is fine.

#include "std.h"

namespace carom::fuzz {

/// A broken guarantee, named by the text.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

struct Target {
  const char* name;
  void (*run)(string_view bytes);  // throws Finding; any other exception is a finding too
  vector<string> (*seeds)();       // initial inputs
  size_t longest;                  // bytes of an input
  int tries = 3000;                // mutated inputs in the short test
};

span<const Target> targets();
/// Null: there is none of this name.
const Target* find_target(string_view name);

/// Words for inputs: keys, choices, punctuation.
vector<string> words();

// One function for each target, and its seeds.
void load_scene_bytes(string_view bytes);
void load_sweep_bytes(string_view bytes);
void apply_settings_bytes(string_view bytes);
void read_mesh_reply_bytes(string_view bytes);
void read_mesh_bytes(string_view bytes);
void read_flights_bytes(string_view bytes);
void read_manifest_bytes(string_view bytes);
void read_table_bytes(string_view bytes);
void read_gzip_bytes(string_view bytes);
void simulate_bytes(string_view bytes);
vector<string> scene_seeds();
vector<string> sweep_seeds();
vector<string> settings_seeds();
vector<string> mesh_reply_seeds();
vector<string> mesh_seeds();
vector<string> flights_seeds();
vector<string> manifest_seeds();
vector<string> table_seeds();
vector<string> gzip_seeds();
vector<string> simulator_seeds();

}  // namespace carom::fuzz
