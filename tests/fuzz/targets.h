#pragma once
// Fuzz targets: functions of arbitrary bytes. Each passes the bytes to a part of the program as the content of a file,
// and checks the result against the guarantees of that part. A refusal by the part's own error is fine.
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace carom::fuzz {

/// A broken guarantee, named by the text.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

struct Target {
  const char* name;
  void (*run)(std::string_view bytes);  // throws Finding; any other exception is a finding too
  std::vector<std::string> (*seeds)();  // initial inputs
  std::size_t longest;                  // bytes of an input
};

std::span<const Target> targets();
/// Null: there is none of this name.
const Target* find_target(std::string_view name);

/// Words for inputs: keys, choices, punctuation.
std::vector<std::string> words();

// One function for each target, and its seeds.
void load_scene_bytes(std::string_view bytes);
void load_sweep_bytes(std::string_view bytes);
void apply_settings_bytes(std::string_view bytes);
void read_mesh_reply_bytes(std::string_view bytes);
void read_mesh_bytes(std::string_view bytes);
void read_flights_bytes(std::string_view bytes);
void read_manifest_bytes(std::string_view bytes);
void read_table_bytes(std::string_view bytes);
void simulate_bytes(std::string_view bytes);
std::vector<std::string> scene_seeds();
std::vector<std::string> sweep_seeds();
std::vector<std::string> settings_seeds();
std::vector<std::string> mesh_reply_seeds();
std::vector<std::string> mesh_seeds();
std::vector<std::string> flights_seeds();
std::vector<std::string> manifest_seeds();
std::vector<std::string> table_seeds();
std::vector<std::string> simulator_seeds();

}  // namespace carom::fuzz
