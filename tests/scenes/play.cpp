#include "scenes/play.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/engine.h"
#include "paths.h"
#include "physics/energy.h"
#include "physics/world.h"
#include "render/mesh.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {

vector<string> scene_names() {
  vector<string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SCENES_DIR)) {
    if (entry.path().extension() != ".yaml" || entry.path().parent_path().filename() == "sweeps") continue;
    names.push_back(entry.path().lexically_relative(SCENES_DIR).replace_extension().generic_string());
  }
  ranges::sort(names);
  return names;
}

Scene load(const string& name) {
  LoadOptions options;
  options.mesh_points = [](const string& path) { return read_mesh_points(path); };
  return load_scene(SCENES_DIR "/" + name + ".yaml", options);
}

string comment_of(const string& name) {
  std::ifstream in(SCENES_DIR "/" + name + ".yaml");
  string comment;
  for (string line; std::getline(in, line) && line.starts_with('#');) {
    for (const char c : line.substr(1) + " ") {
      if (c != ' ' || !comment.ends_with(' ')) comment += c;
    }
  }
  return comment;
}

double stated(const string& name, const string& words) {
  const string comment = comment_of(name);
  const size_t at = comment.find(words);
  if (at == string::npos || comment.find(words, at + 1) != string::npos) {
    ADD_FAILURE() << name << " does not say once: " << words;
    return std::nan("");
  }
  return std::stod(comment.substr(at + words.size()));
}

Entity Played::number(const string& name) const {
  const size_t strings_from = scene.world.body_count() + scene.world.fixed_count();
  for (Entity e = 0; e < strings_from + scene.world.strings.size(); ++e) {
    if (scene.roster.name(e) == name) return e;
  }
  throw runtime_error("no " + name);
}

vector<Collision> Played::of(const string& name) const {
  vector<Collision> own;
  const Entity e = number(name);
  std::copy_if(collisions.begin(), collisions.end(), std::back_inserter(own),
               [e](const Collision& c) { return c.a == e || c.b == e; });
  return own;
}

Played play(const string& name, const vector<double>& times) {
  Played run{load(name), {}, {}, {}, {}, {}};
  const auto simulator = make_simulator(run.scene, {.collisions = true});
  run.energy_start =
      kinetic_energy(run.scene.world, simulator->state()) + potential_energy(run.scene.world, simulator->state());

  const auto go_to = [&](double time) {
    do {
      simulator->advance_to(time);
      for (const Collision& c : simulator->collisions()) {
        (c.kind == CollisionKind::rest ? run.rests : run.collisions).push_back(c);
      }
    } while (simulator->time() < time);
  };

  for (const double time : times) {
    go_to(time);
    run.states.push_back(simulator->state());
  }

  go_to(run.scene.simulate.duration);
  run.end = simulator->state();
  run.tally = simulator->tally();
  return run;
}

}  // namespace carom::testing
