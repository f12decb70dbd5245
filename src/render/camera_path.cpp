#include "render/camera_path.h"

namespace carom {
namespace {

template <typename Value>
std::vector<Value> column(const std::vector<Keyframe>& keys, Value Keyframe::*member) {
  std::vector<Value> values;
  for (const Keyframe& key : keys) values.push_back(key.*member);
  return values;
}

}  // namespace

CameraPath::CameraPath(const std::vector<Keyframe>& keys)
    : eye_(column(keys, &Keyframe::at), column(keys, &Keyframe::eye)),
      target_(column(keys, &Keyframe::at), column(keys, &Keyframe::target)),
      fov_(column(keys, &Keyframe::at), column(keys, &Keyframe::fov)) {}

}  // namespace carom
