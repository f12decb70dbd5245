// Follows the words of the path through the kinds of the table. A word for a name or an index is skipped, since no
// scene is at hand.
#include "scene/path_field.h"

#include "std.h"

namespace carom {

namespace {

/// The fields along the path. Empty: no such field.
vector<const Field*> fields_along(string_view path) {
  vector<const Field*> fields;
  const Kind* kind = &kind_named("scene");
  // The next word is a name or a number, not a key.
  bool name_next = false;

  for (size_t i = 0; i <= path.size();) {
    const size_t end = min(path.find('.', i), path.size());
    const string_view word = path.substr(i, end - i);
    i = end + 1;

    if (name_next) {
      name_next = false;
      kind = kind->also != nullptr && word == kind->also->key ? nullptr : kind;
    } else if (kind != nullptr) {
      const Field* field = find_field(*kind, word);
      // An entry of the list that may stand in place of this map.
      const string_view plain = fields.empty() ? string_view() : fields.back()->plain;
      if (field == nullptr && !plain.empty() && word.find_first_not_of("0123456789") == string_view::npos) {
        fields.push_back(find_field(*kind, plain));
        kind = fields.back()->held;
        continue;
      }
      if (field == nullptr) return {};
      fields.push_back(field);
      name_next = holds_entries(*field);
      kind = field->held;
    }
  }
  return fields;
}

}  // namespace

string words_of(string_view path) {
  string thing, words;
  const Kind* kind = &kind_named("scene");
  const Field* before = nullptr;

  for (size_t i = 0; i <= path.size();) {
    const size_t end = min(path.find('.', i), path.size());
    const string word(path.substr(i, end - i));
    i = end + 1;
    const Field* const field = kind != nullptr ? find_field(*kind, word) : nullptr;

    if (before != nullptr && holds_entries(*before)) {
      // A name, or the number of an entry in a list.
      thing = before->type == Type::list ? string(before->held->name) + " " + word : word;
      words.clear();
      before = nullptr;
      continue;
    }
    if (before != nullptr && before->type == Type::values) {
      words = word;
    } else if (field != nullptr) {
      if (before != nullptr && before->key == "defaults") thing = word;
      words = title_of(*field);
    } else {
      // A component, or the number of a group's member.
      words += (words.empty() ? "" : " ") + word;
    }

    before = field;
    kind = field != nullptr ? field->held : nullptr;
  }

  if (thing.empty() || words.empty()) return thing + words;
  if (words[0] >= 'A' && words[0] <= 'Z') words[0] = char(words[0] - 'A' + 'a');
  return thing + ": " + words;
}

const Field* field_at(string_view path) {
  const vector<const Field*> fields = fields_along(path);
  return fields.empty() ? nullptr : fields.back();
}

bool is_drawn(string_view path) {
  const vector<const Field*> fields = fields_along(path);
  return any_of(fields, [](const Field* field) { return field->drawn; });
}

}  // namespace carom
