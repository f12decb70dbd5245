#pragma once
// Files in gzip (RFC 1952), in members that each have the same number of bytes before compression. So the bytes depend
// neither on when they are written nor on whether a run was interrupted: what does not fill a member waits.

#include "files/deflation.h"
#include "files/file_place.h"
#include "std.h"

namespace carom {

/// The ending of such a file's name.
inline constexpr string_view gzip_ending = ".gz";

class GzipMembers {
 public:
  /// Takes the compressed bytes of a member.
  using Take = function<void(string_view)>;

  void add(string_view bytes, const Take& take);
  /// Ends the file, with a shorter member if need be.
  void end(const Take& take);

  /// The bytes that do not fill a member.
  const string& rest() const { return rest_; }
  void set_rest(string rest) { rest_ = std::move(rest); }

 private:
  void put(string_view bytes, const Take& take);

  string rest_;
  vector<uint8_t> packed_;
  Deflation deflation_;
};

/// Writes to `to` what the gzip file `from` holds, both from their present positions on. Members of any size and by any
/// program are read. Throws ExportError: "cannot read <place>/<name>: it is damaged, or cut off".
void unpack_gzip(int from, int to, const FilePlace& place, const string& name);

}  // namespace carom
