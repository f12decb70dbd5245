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

const Field* field_at(string_view path) {
  const vector<const Field*> fields = fields_along(path);
  return fields.empty() ? nullptr : fields.back();
}

bool is_drawn(string_view path) {
  const vector<const Field*> fields = fields_along(path);
  return any_of(fields, [](const Field* field) { return field->drawn; });
}

}  // namespace carom
