#include "simulate/references.h"

#include <fstream>

#include "paths.h"
#include "std.h"

namespace carom {

nlohmann::json reference(const string& name) {
  std::ifstream file(string(DATA_DIR) + "/references/" + name + ".json");
  return nlohmann::json::parse(file);
}

Vec3 vec3(const nlohmann::json& j) {
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

double number(const nlohmann::json& j) {
  if (j.is_number()) return j.get<double>();
  const string s = j.get<string>();
  const auto slash = s.find('/');
  return slash == string::npos ? std::stod(s) : std::stod(s.substr(0, slash)) / std::stod(s.substr(slash + 1));
}

}  // namespace carom
