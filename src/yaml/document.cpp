// Builds the tree from yaml-cpp's events and not with YAML::Load. One pass checks and builds.
// A hostile file is refused before memory is spent on it, aliases never expand,
// and quoted text stays distinct from plain text.
// YAML::Load would also keep duplicate keys, ignore a second document, and lose the place of an implicit null.
#include "yaml/document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <unordered_map>

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/letters.h"
#include "yaml/syntax.h"

namespace carom {
namespace {

constexpr size_t max_depth = 32;
constexpr size_t max_values = 6'000'000;
constexpr size_t max_text = 10'000;  // bytes of one scalar
// Of aliases, duplicate keys and the like, before parsing stops.
constexpr int max_refusals = 200;

/// Thrown after an error that makes the rest of the text meaningless.
struct Stop {};

class DocumentBuilder : public YAML::EventHandler {
 public:
  DocumentBuilder(string_view text, uint32_t source, size_t base, Diagnostics& diagnostics)
      : text_(text), source_(source), base_(base), diagnostics_(diagnostics) {}

  Node root;
  int documents = 0;

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents == 1) return;

    // A setting begins with its value. What follows a bracket shows that a text is meant.
    const size_t first = text_.find_first_not_of(' ', base_);
    if (source_ > 0 && first != string_view::npos && (text_[first] == '{' || text_[first] == '[')) {
      refuse(at(mark), string(text_after_bracket), string(quotes_for_bracket));
    } else if (!root.is_map()) {
      refuse({source_, 0, 1}, "this is not a scene", "expected a map of keys, such as `scene: 1`");
    } else if (at(mark).offset == base_) {
      refuse(at(mark), "this is not a scene", "expected a map of keys, such as `scene: 1`");

    } else {
      const Place where = at(mark);
      const bool marker = text_.substr(where.offset, 3) == "---";
      refuse(where, marker ? "a second document begins here" : "this does not belong to the map above",
             marker ? "expected one scene a file" : "expected `key: value` at the indentation of the lines above");
    }
    throw Stop{};
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    check_anchor(mark, anchor);
    Node node;
    node.place = awaits_value() ? key().place : at(mark);
    if (awaits_key()) {
      refuse(at(mark), "a value without a key", "expected `key: value`");
      open_.back().pending = Key{"", at(mark)};
      return;
    }
    add(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(at(mark, word_length(mark)), "an alias", "expected the value itself: scenes have no anchors and aliases");
    scalar(at(mark), "", false, true);
  }

  void OnScalar(const YAML::Mark& mark, const string& tag, YAML::anchor_t anchor, const string& value) override {
    check_anchor(mark, anchor);
    check_tag(mark, tag);

    const bool is_quoted = tag == "!";
    Place place = at(mark, 1);

    if (value.size() > max_text) {
      refuse(place, fmt::format("a text of {} bytes", value.size()), fmt::format("expected at most {}", max_text));
      throw Stop{};
    }

    // The raw text may be folded or escaped. Then the place is a single character.
    const string_view raw = text_.substr(place.offset);
    if (raw.starts_with(value) && !value.empty()) place.length = uint32_t(value.size());
    if (is_quoted && raw.size() > value.size() + 1 && raw.substr(1, value.size()) == value &&
        (raw[0] == '"' || raw[0] == '\'')) {
      place.length = uint32_t(value.size() + 2);
    }

    check_decoded(place, value);
    scalar(place, value, is_quoted, false);
  }

  void OnSequenceStart(const YAML::Mark& mark, const string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(Node::Kind::sequence, mark, tag, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(Node::Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  /// A collection that is being read.
  struct Open {
    Node node;
    // A map's key that waits for its value.
    optional<Key> pending;
    std::unordered_map<string, size_t> index;  // keys, once there are many
  };

  Place at(const YAML::Mark& mark, size_t length = 1) const {
    const size_t offset = min(base_ + size_t(max(mark.pos, 0)), text_.size());
    return {source_, uint32_t(offset), uint32_t(length)};
  }
  size_t word_length(const YAML::Mark& mark) const {
    const size_t begin = at(mark).offset;
    return max<size_t>(1, min(text_.find_first_of(" \n,]}", begin), text_.size()) - begin);
  }
  void refuse(Place place, string message, string remedy) {
    diagnostics_.add(place, std::move(message), std::move(remedy));
    if (++refusals_ > max_refusals) throw Stop{};
  }

  bool in_map() const { return !open_.empty() && open_.back().node.is_map(); }
  bool awaits_key() const { return in_map() && !open_.back().pending; }
  bool awaits_value() const { return in_map() && open_.back().pending; }
  const Key& key() const { return *open_.back().pending; }

  void check_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) refuse(at(mark, word_length(mark)), "an anchor", "remove it: scenes have no anchors and aliases");
  }
  void check_tag(const YAML::Mark& mark, const string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(at(mark, word_length(mark)), "a tag", "remove it: the key determines the type of its value");
    }
  }
  /// Escapes such as "\0" or "\uD800" produce text that the check of the raw bytes did not cover.
  void check_decoded(Place place, const string& value) {
    for (size_t i = 0; i < value.size();) {
      char32_t code = 0;
      const int length = utf8_length(value, i, code);
      if (length == 0 || (is_control(code) && code != '\n')) {
        refuse(place, "this text holds a control character", "expected plain text");
        throw Stop{};
      }
      i += size_t(length);
    }
  }

  void scalar(Place place, const string& value, bool is_quoted, bool bad) {
    if (awaits_key()) {
      if (value == "<<" && !is_quoted) {
        refuse(place, "`<<` merges maps in some YAML dialects, not in a scene",
               "write the keys out, or use `defaults`");
      }
      if (value.empty()) refuse(place, "an empty key", "expected a name");
      open_.back().pending = Key{value, place};
      return;
    }

    Node node;
    node.kind = Node::Kind::scalar;
    node.quoted = is_quoted;
    node.bad = bad;
    node.place = place;
    node.text = value;
    add(std::move(node));
  }

  void begin(Node::Kind kind, const YAML::Mark& mark, const string& tag, YAML::anchor_t anchor) {
    check_anchor(mark, anchor);
    check_tag(mark, tag);

    if (open_.size() >= max_depth) {
      refuse(at(mark), fmt::format("values are nested more than {} deep", max_depth), "expected a scene");
      throw Stop{};
    }
    if (awaits_key()) {
      refuse(at(mark), "a list or map as a key", "expected a name");
      throw Stop{};
    }

    Open open;
    open.node.kind = kind;
    open.node.place = at(mark);
    // The mark of a block is that of its first line. The place of its key is more useful.
    const char first = open.node.place.offset < text_.size() ? text_[open.node.place.offset] : ' ';
    if (awaits_value() && first != '{' && first != '[') open.node.place = key().place;
    open_.push_back(std::move(open));
  }

  void end() {
    Node node = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(node));
  }

  void add(Node node) {
    if (++values_ > max_values) {
      refuse(node.place, fmt::format("more than {} values", max_values),
             "many balls of one kind are a group: `groups`");
      throw Stop{};
    }

    if (open_.empty()) {
      root = std::move(node);
      return;
    }

    Open& parent = open_.back();
    if (parent.node.is_map()) {
      Key name = std::move(*parent.pending);
      parent.pending.reset();
      if (name.text == "<<" || name.text.empty()) return;  // reported

      const Key* first = first_with(parent, name.text);
      if (first != nullptr) {
        const auto line = 1 + std::count(text_.begin(), text_.begin() + first->place.offset, '\n');
        refuse(name.place, fmt::format("{} is repeated", in_backticks(name.text)),
               fmt::format("it is in line {} already", line));
        return;
      }

      parent.node.keys.push_back(std::move(name));
      index_last_key(parent);
    }
    parent.node.items.push_back(std::move(node));
  }

  static constexpr size_t many = 32;

  static const Key* first_with(const Open& open, const string& name) {
    if (open.node.keys.size() < many) return open.node.find_key(name);
    const auto it = open.index.find(name);
    return it == open.index.end() ? nullptr : &open.node.keys[it->second];
  }

  static void index_last_key(Open& open) {
    const vector<Key>& keys = open.node.keys;
    if (keys.size() < many) return;
    for (size_t i = keys.size() == many ? 0 : keys.size() - 1; i < keys.size(); ++i)
      open.index.emplace(keys[i].text, i);
  }

  string_view text_;
  uint32_t source_;
  size_t base_;
  Diagnostics& diagnostics_;
  vector<Open> open_;
  size_t values_ = 0;
  int refusals_ = 0;
};

}  // namespace

void remove_key(Node& map, string_view key) {
  for (size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].text != key) continue;
    map.keys.erase(map.keys.begin() + ptrdiff_t(i));
    map.items.erase(map.items.begin() + ptrdiff_t(i));
    return;
  }
}

void set_key(Node& map, string_view key, Node value) {
  if (Node* node = map.find(key)) {
    *node = std::move(value);
    return;
  }
  map.keys.push_back({string(key), value.place});
  map.items.push_back(std::move(value));
}

const Key* Node::find_key(string_view key) const {
  for (const Key& k : keys) {
    if (k.text == key) return &k;
  }
  return nullptr;
}

const Node* Node::find(string_view key) const {
  const Key* k = find_key(key);
  return k == nullptr || items.size() != keys.size() ? nullptr : &items[size_t(k - keys.data())];
}

Node* Node::find(string_view key) {
  return const_cast<Node*>(static_cast<const Node&>(*this).find(key));
}

optional<Node> parse_document(const vector<Source>& sources, uint32_t index, size_t offset, Diagnostics& diagnostics) {
  const Source& source = sources[index];
  DocumentBuilder builder(source.text, index, offset, diagnostics);
  try {
    // The end marker turns an unclosed quote into an error. At a plain end of file yaml-cpp may accept it.
    std::istringstream stream(source.text.substr(offset) + "\n...\n");
    YAML::Parser parser(stream);
    // Not `while (HandleNextDocument)`, which never ends on ",". The builder throws at a second document.
    if (parser.HandleNextDocument(builder)) parser.HandleNextDocument(builder);
  } catch (const Stop&) {
    return nullopt;
  } catch (const YAML::Exception& error) {
    const size_t pos = error.mark.is_null() ? 0 : size_t(max(error.mark.pos, 0));
    explain_syntax(source, index, offset, min(offset + pos, source.text.size()), error.msg, diagnostics);
    return nullopt;
  }

  if (builder.documents == 0) return Node{};
  return std::move(builder.root);
}

}  // namespace carom
