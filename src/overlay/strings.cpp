// The things that a hanging string would lie on are not considered.
#include "overlay/strings.h"

#include "overlay/hanging_curve.h"
#include "overlay/wire.h"
#include "std.h"

namespace carom {
namespace {

constexpr double string_radius = 0.06, rod_radius = 0.1;  // of the smaller body's radius
const Color hemp = from_rgb(0x8a6d3b);

void add_string(const Moment& moment, const String& string, vector<Stroke>& strokes) {
  const bool tied = string.other != no_entity;
  const Vec3 from = moment.state.position[string.body];
  const Vec3 to = tied ? moment.state.position[string.other] : string.anchor;
  double reach = moment.radius_of(string.body);
  if (tied) reach = min(reach, moment.radius_of(string.other));
  Wire wire((string.rod ? rod_radius : string_radius) * reach, from, string.rod ? wire_steel : hemp, strokes);
  if (string.rod) return wire.go_to(to);
  const Vec3& gravity = moment.world.gravity;
  const Vec3 down = gravity.isZero(0) ? Vec3(Vec3::Zero()) : Vec3(gravity.stableNormalized());
  const double error = chord_error * min(moment.pixel_at(from), moment.pixel_at(to));
  for (const Vec3& point : hanging_curve(from, to, string.length, down, error)) wire.go_to(point);
}

}  // namespace

void add_strings(const Moment& moment, vector<Stroke>& strokes) {
  const vector<String>& strings = moment.world.strings;
  const vector<size_t>& hidden = moment.scene.overlay.hidden_strings;
  for (size_t k = 0; k < strings.size(); ++k) {
    const String& string = strings[k];
    const bool is_cut = !(moment.state.time < string.until) || moment.is_part(string.body) ||
                        (string.other != no_entity && moment.is_part(string.other));
    if (!is_cut && !std::binary_search(hidden.begin(), hidden.end(), k)) add_string(moment, string, strokes);
  }
}

}  // namespace carom
