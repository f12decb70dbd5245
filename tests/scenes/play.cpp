#include "scenes/play.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "physics/energy.h"
#include "physics/world.h"
#include "render/mesh.h"
#include "run/engine.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace carom::testing {

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SCENES_DIR)) {
    if (entry.path().extension() != ".yaml" || entry.path().parent_path().filename() == "sweeps") continue;
    names.push_back(entry.path().lexically_relative(SCENES_DIR).replace_extension().generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Scene load(const std::string& name) {
  LoadOptions options;
  options.mesh_points = [](const std::string& path) { return read_mesh_points(path); };
  return load_scene(SCENES_DIR "/" + name + ".yaml", options);
}

std::string comment_of(const std::string& name) {
  std::ifstream in(SCENES_DIR "/" + name + ".yaml");
  std::string comment;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    for (const char c : line.substr(1) + " ") {
      if (c != ' ' || !comment.ends_with(' ')) comment += c;
    }
  }
  return comment;
}

double stated(const std::string& name, const std::string& words) {
  const std::string comment = comment_of(name);
  const std::size_t at = comment.find(words);
  if (at == std::string::npos || comment.find(words, at + 1) != std::string::npos) {
    ADD_FAILURE() << name << " does not say once: " << words;
    return std::nan("");
  }
  return std::stod(comment.substr(at + words.size()));
}

Entity Played::number(const std::string& name) const {
  const std::size_t strings_from = scene.world.body_count() + scene.world.fixed_count();
  for (Entity e = 0; e < strings_from + scene.world.strings.size(); ++e) {
    if (scene.roster.name(e) == name) return e;
  }
  throw std::runtime_error("no " + name);
}

std::vector<Collision> Played::of(const std::string& name) const {
  std::vector<Collision> own;
  const Entity e = number(name);
  std::copy_if(collisions.begin(), collisions.end(), std::back_inserter(own),
               [e](const Collision& c) { return c.a == e || c.b == e; });
  return own;
}

Played play(const std::string& name, const std::vector<double>& times) {
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
