#include "simulate/references.h"

#include <fstream>

namespace carom {

nlohmann::json reference(const std::string& name) {
  std::ifstream file(std::string(DATA_DIR) + "/references/" + name + ".json");
  return nlohmann::json::parse(file);
}

Vec3 vec3(const nlohmann::json& j) {
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

double number(const nlohmann::json& j) {
  if (j.is_number()) return j.get<double>();
  const std::string s = j.get<std::string>();
  const auto slash = s.find('/');
  return slash == std::string::npos ? std::stod(s) : std::stod(s.substr(0, slash)) / std::stod(s.substr(slash + 1));
}

}  // namespace carom
