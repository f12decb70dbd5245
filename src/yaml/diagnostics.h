#pragma once
// Errors with places, collected, sorted and shown: place, line, caret, remedy.

#include "std.h"
#include "yaml/place.h"

namespace carom {

/// A part of a text, in bytes. Length 0: none.
struct TextSpan {
  size_t at = 0, length = 0;
};

/// What is wrong with a text, and where. Length 0: with all of it.
struct TextFault {
  string text;
  TextSpan span{};
};

/// The two parts of "fault\n  remedy" or "fault. Remedy: remedy". `remedy` is empty if there is none.
struct TextRemedy {
  string fault, remedy;
};
TextRemedy fault_and_remedy(string_view text);

/// An error in parts, for other programs.
struct ErrorRecord {
  string file;  // or the option: "--set balls.red.mass=x"; empty: none
  /// From 1, the column in characters. 0: the error has no place in the file.
  size_t line = 0, column = 0;
  string message;
  string remedy;  // lines; empty: none
  string near;    // what was probably meant: "radius"; empty: unknown
};

class Diagnostics {
 public:
  /// `sources`: the texts that places point into, the file first, then one per --set. They must outlive this object.
  explicit Diagnostics(const vector<Source>& sources) : sources_(sources) {}

  /// `remedy`: what was expected, or a suggestion. Each of its lines is one remedy. A character of the marked text that
  /// is only like one of ASCII is named there as well. At a place of repeated things, errors that differ by numbers
  /// alone are one, which has the number of members.
  void add(Place place, string message, string remedy = {});
  /// An error of a file as a whole: "path: error: message".
  void add_unplaced(string name, string message, string remedy = {});
  /// A value or key at this place belongs to each member of a repeated thing.
  void mark_repeated(Place place);
  /// Adds an error that another member has already. False: none has. It saves the search for a remedy.
  bool add_member(Place place, string_view message);

  /// Whether a --set option gave what stands there.
  bool is_option(Place place) const { return sources_[place.source].option; }

  bool empty() const { return errors_.empty(); }
  size_t count() const { return errors_.size(); }
  /// Grows with every error, also with those of further members.
  size_t added() const { return added_; }

  /// All errors in the order of the file. Each error has this form:
  ///   path:line:column: error: message
  ///    line | text of the line
  ///         |      ^~~~
  ///         = remedy
  /// Lines and columns count from 1, columns in characters.
  string text(bool color) const;
  /// The same errors in parts.
  vector<ErrorRecord> records() const;

 private:
  struct Error {
    bool placed;
    Place place;
    string name, message, remedy;
    size_t members = 1;
  };
  vector<const Error*> in_order() const;
  static string remedy_of(const Error& error);
  string show(const Error& error, bool color) const;

  const vector<Source>& sources_;
  vector<Error> errors_;
  size_t added_ = 0;
  set<pair<uint32_t, uint32_t>> repeated_;  // sources and offsets
  /// By place and message without numbers: the number of the error.
  map<string, size_t> first_of_alike_;
};

/// `text` between backticks, for use inside a message: shortened and free of control characters.
string in_backticks(string_view text);

/// The name in "did you mean `name`?". Empty: the text does not suggest one.
string suggestion_in(string_view text);

/// The closest name in `candidates`: few letters differ, and two swapped letters count as one difference.
/// Empty: none is near. Of equally near names the first is returned.
string nearest(string_view name, const vector<string_view>& candidates);

/// "`red`, `blue` and 7 more". Members of a repeated thing are one name.
string names_text(const vector<string_view>& names, size_t most);

/// What to say of a name that is not there: "did you mean `red`?", or "there are `red`, `blue` and 7 more". Empty:
/// there are no names.
string suggest_name(string_view name, const vector<string_view>& candidates);

}  // namespace carom
