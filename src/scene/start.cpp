// Changes the tree and not the decoded scene. All that follows, from the check of overlaps to the resolved scene, then
// knows bodies with numbers alone.
#include "scene/start.h"

#include <fmt/format.h>

#include <unordered_map>

#include "scene/check.h"
#include "scene/decode.h"
#include "scene/expand.h"
#include "scene/fields.h"
#include "scene/former_state.h"
#include "scene/keys.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr size_t names_shown = 5;

string names_text(const vector<string>& names) {
  return carom::names_text({names.begin(), names.end()}, names_shown);
}

Node number_node(double value, Place place) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.place = place;
  node.text = shortest(value);
  return node;
}

Node vector_node(const Vec3& value, Place place) {
  Node node;
  node.kind = Node::Kind::sequence;
  node.place = place;
  for (int k = 0; k < 3; ++k) node.items.push_back(number_node(value[k], place));
  return node;
}

/// The key, or the part that a --set gave.
Place place_of_start(const Node& root) {
  const Place part = View(&root, kind_named("scene"), Place{}).place("start");
  return part.source > 0 ? part : root.find_key("start")->place;
}

class Starter {
 public:
  Starter(Node& root, FormerState former, MadeFrom& made_from, Diagnostics& diagnostics)
      : root_(root),
        former_(std::move(former)),
        made_from_(made_from),
        diagnostics_(diagnostics),
        place_(place_of_start(root)),
        used_(former_.names.size(), false) {
    numbers_.reserve(former_.names.size());
    for (size_t i = 0; i < former_.names.size(); ++i) numbers_.emplace(former_.names[i], i);
  }

  void run() {
    if (Node* start = root_.find("start")) set_key(*start, "at", number_node(former_.state.time, place_));

    each("balls", [&](const Key& key, Node& node) { body("balls", kind_named("ball"), key, node); });
    each("bodies", [&](const Key& key, Node& node) { body("bodies", kind_named("body"), key, node); });
    each("groups", [&](const Key& key, Node& node) { group(key, node); });

    if (!gone_.empty())
      diagnostics_.add(place_,
                       fmt::format("at {} s of the run {} {} out of the world: merged into another body, removed by a "
                                   "region, or yet to appear",
                                   time(), names_text(gone_), gone_.size() == 1 ? "is" : "are"),
                       "expected a scene without such bodies, or another `at`");
    else if (!contains(used_, true))
      diagnostics_.add(place_, "the run has none of the bodies of this scene",
                       former_.names.empty() ? "expected a run with bodies"
                                             : "bodies match by their names; the run has " + names_text(former_.names));

    note();
  }

 private:
  template <typename Work>
  void each(string_view name, const Work& work) {
    Node* map = root_.find(name);
    if (map == nullptr || !map->is_map()) return;
    for (size_t i = 0; i < map->keys.size(); ++i)
      if (map->items[i].is_map() && map->items[i].find_key("repeat") == nullptr) work(map->keys[i], map->items[i]);
  }

  string time() const { return shortest(former_.state.time); }

  bool is_gone(size_t i) const { return !former_.state.part_of.empty() && former_.state.part_of[i] != i; }

  /// The body of this name in the run; it counts as used. -1: there is none, or it is gone, which is kept in gone_.
  ptrdiff_t take(const string& name) {
    const auto found = numbers_.find(name);
    if (found == numbers_.end()) {
      own_.push_back(name);
      return -1;
    }
    if (is_gone(found->second)) {
      gone_.push_back(name);
      return -1;
    }
    used_[found->second] = true;
    return ptrdiff_t(found->second);
  }

  void body(const string& map, const Kind& kind, const Key& key, Node& node) {
    const ptrdiff_t i = take(key.text);
    if (i < 0) return;
    const View view = thing_view(root_, key, node, kind);
    replaces(view, {"position", "velocity", "impulse"}, key.text);
    drop_impulse(view, node, key.text);
    set_key(node, "position", vector_node(former_.state.position[size_t(i)], place_));
    set_key(node, "velocity", vector_node(former_.state.velocity[size_t(i)], place_));
    forget(map + "." + key.text, {"position", "velocity", "impulse"});
  }

  void group(const Key& key, Node& node) {
    const Kind& kind = kind_named("group");
    const View view = thing_view(root_, key, node, kind);
    const auto name = [&](uint64_t k) { return fmt::format("{}.{}", key.text, k); };

    // As many balls as the run has.
    const uint64_t count = filled<GroupKeys>(view).count;
    uint64_t there = 0;
    while (numbers_.contains(name(there))) ++there;
    if (count == 0) return;
    if (there == 0) return own_.push_back(key.text);

    if (there != count) {
      diagnostics_.add(view.place("count"),
                       fmt::format("{} has {}, and the run has {}", in_backticks(key.text), balls(count), there),
                       fmt::format("expected `count`: {}, or another name, which the run does not have", there));
      for (uint64_t k = 0; k < there; ++k) used_[numbers_.at(name(k))] = true;
      return;
    }

    // Each ball where it is in the run, with the size and mass that the scene lists.
    const Node* listed = view.given("members");
    const bool lists = listed != nullptr && listed->items.size() == count;
    replaces(view, {"in", "arrange", "speed", "velocity", "members"}, key.text);
    Node members;
    members.kind = Node::Kind::sequence;
    members.place = place_;
    members.items.reserve(count);

    for (uint64_t k = 0; k < count; ++k) {
      const ptrdiff_t i = take(name(k));
      if (i < 0) continue;
      Node& member = members.items.emplace_back();
      member.kind = Node::Kind::map;
      member.place = place_;
      set_key(member, "position", vector_node(former_.state.position[size_t(i)], place_));
      set_key(member, "velocity", vector_node(former_.state.velocity[size_t(i)], place_));
      for (const string_view own : {"radius", "mass"})
        if (const Node* value = lists ? listed->items[k].find(own) : nullptr) set_key(member, own, *value);
    }

    if (members.items.size() < count) return;
    // The ball may be that of the defaults.
    if (const Node* ball = view.given("ball"); ball != nullptr && ball->is_map()) {
      const View each_ball = member_view(root_, view);
      replaces(each_ball, {"velocity", "impulse"}, key.text);
      Node own = *ball;
      drop_impulse(each_ball, own, key.text);
      set_key(node, "ball", std::move(own));
    }

    for (const string_view rule : {"in", "arrange", "speed", "velocity"}) remove_key(node, rule);
    set_key(node, "members", std::move(members));
    forget("groups." + key.text, {"in", "arrange", "speed", "velocity", "members", "ball.velocity", "ball.impulse"});
  }

  /// A value that a --set or a sweep gives would have no effect without a word.
  void replaces(const View& view, std::initializer_list<string_view> keys, const string& name) {
    for (const string_view key : keys) {
      const Node* node = find_field(view.kind(), key) == nullptr ? nullptr : view.given(key);
      if (node == nullptr || !diagnostics_.is_option(place_of(*node))) continue;
      diagnostics_.add(
          place_of(*node),
          fmt::format("{} of {} has no effect: `start` takes its place", in_backticks(key), in_backticks(name)),
          "expected no such setting of a body that begins as the former run had it");
    }
  }

  /// The run has applied the impulse, so that the velocity there contains it.
  void drop_impulse(const View& view, Node& node, const string& name) {
    const optional<Vec3> impulse = view.vector("impulse");
    if (!impulse || impulse->isZero(0)) return;
    kicked_.push_back(name);
    set_key(node, "impulse", vector_node(Vec3(0, 0, 0), place_));
  }

  /// No expression of the file made these values.
  void forget(const string& thing, std::initializer_list<string_view> keys) {
    if (made_from_.expressions.empty()) return;
    const size_t dot = thing.find('.');
    const string_view family = family_of(string_view(thing).substr(dot + 1));
    const string whole = family.empty() ? thing : thing.substr(0, dot + 1) + string(family);
    ExpressionTexts& texts = made_from_.expressions;
    for (const string_view key : keys) {
      const string path = fmt::format("{}.{}", whole, key);
      texts.erase(path);
      for (auto text = texts.lower_bound(path + "."); text != texts.end() && text->first.starts_with(path + ".");)
        text = texts.erase(text);
    }
  }

  void note() {
    vector<string> left;
    for (size_t i = 0; i < used_.size(); ++i)
      if (!used_[i] && !is_gone(i)) left.push_back(former_.names[i]);

    const auto say = [&](string text) { made_from_.notes.push_back(std::move(text)); };
    if (!own_.empty())
      say(fmt::format("start: the run has no {}, which {} where this scene places {}", names_text(own_),
                      own_.size() == 1 ? "begins" : "begin", own_.size() == 1 ? "it" : "them"));
    if (!left.empty()) say(fmt::format("start: this scene has no {}, which the run has", names_text(left)));

    if (!kicked_.empty())
      say(fmt::format("start: the impulse of {} is not applied again: the velocities of the run contain it",
                      names_text(kicked_)));

    if (former_.has_merged)
      say("start: bodies of the run had merged by then; masses and sizes are those of this scene");
    if (!former_.doubt.empty()) say("start: the run is doubtful: " + former_.doubt);
    if (former_.state.time > 0 && has_times())
      say(fmt::format("start: times of forces, motions and strings count from the new time 0, which is {} s of the run",
                      time()));
  }

  bool has_times() const {
    const auto has = [](const Node& node, std::initializer_list<string_view> keys) {
      return any_of(keys, [&](string_view key) { return node.find_key(key) != nullptr; });
    };
    if (const Node* forces = root_.find("forces"))
      for (const Node& force : forces->items)
        if (has(force, {"from", "until"})) return true;

    for (const string_view kind : {"planes", "walls", "obstacles"})
      if (const Node* things = root_.find(kind))
        for (const Node& thing : things->items)
          if (has(thing, {"motion"})) return true;
    if (const Node* strings = root_.find("strings"))
      for (const Node& string : strings->items)
        if (has(string, {"until"})) return true;
    return false;
  }

  static string balls(uint64_t count) { return fmt::format("{} {}", count, count == 1 ? "ball" : "balls"); }

  Node& root_;
  const FormerState former_;
  MadeFrom& made_from_;
  Diagnostics& diagnostics_;
  const Place place_;
  vector<bool> used_;  // by body of the run
  std::unordered_map<string, size_t> numbers_;
  // Names of this scene: those that the run lacks, those that are gone there, those with an impulse.
  vector<string> own_, gone_, kicked_;
};

}  // namespace

void apply_start(Node& root, const string& folder, const LoadOptions& options, MadeFrom& made_from,
                 Diagnostics& diagnostics) {
  const Node* node = root.find("start");
  if (node == nullptr || node->bad || !node->is_map()) return;

  const View view = scene_part(root, "start");
  const auto keys = filled<StartKeys>(view);
  if (!keys.run || (view.given("at") != nullptr && !keys.at)) return;

  const auto refuse = [&](const StartError& error) {
    const string_view key = error.of_time && keys.at ? "at" : "run";
    diagnostics.add(view.place(key),
                    fmt::format("the run {} cannot be used: {}", in_backticks(*keys.run), error.what()), error.remedy);
  };

  StartedFrom from;
  from.run = *keys.run;
  from.folder = beneath(folder, *keys.run);
  if (!options.former_state) return refuse({"there is no reader of runs here", "expected a scene without `start`"});

  optional<FormerState> former;
  try {
    former = options.former_state(from.folder, keys.at);
  } catch (const StartError& error) {
    return refuse(error);
  }

  from.at = former->state.time;
  from.file = former->file;
  from.sha256 = former->sha256;
  made_from.start = std::move(from);
  Starter(root, std::move(*former), made_from, diagnostics).run();
}

}  // namespace carom
