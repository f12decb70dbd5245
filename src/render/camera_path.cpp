#include "render/camera_path.h"

#include "std.h"

namespace carom {
namespace {

template <typename Value>
vector<Value> column(const vector<Keyframe>& keys, Value Keyframe::*member) {
  vector<Value> values;
  for (const Keyframe& key : keys) values.push_back(key.*member);
  return values;
}

}  // namespace

CameraPath::CameraPath(const vector<Keyframe>& keys)
    : eye_(column(keys, &Keyframe::at), column(keys, &Keyframe::eye)),
      target_(column(keys, &Keyframe::at), column(keys, &Keyframe::target)),
      fov_(column(keys, &Keyframe::at), column(keys, &Keyframe::fov)) {}

}  // namespace carom
