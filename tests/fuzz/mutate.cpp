#include "fuzz/mutate.h"

#include "std.h"

namespace carom::fuzz {

uint64_t Mutator::draw(uint64_t below) {
  state_ = state_ * 6364136223846793005u + 1442695040888963407u;
  return (state_ >> 33) % below;
}

void Mutator::change(string& bytes) {
  const size_t at = draw(bytes.size() + 1), length = std::min<size_t>(1 + draw(16), bytes.size() - at);
  switch (draw(8)) {
    case 0:  // a bit
      if (length > 0) bytes[at] = static_cast<char>(bytes[at] ^ (1 << draw(8)));
      break;
    case 1:  // a byte
      if (length > 0) bytes[at] = static_cast<char>(draw(256));
      break;

    case 2:  // a part removed
      bytes.erase(at, length);
      break;
    case 3:  // a part doubled
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 4:  // cut off
      bytes.resize(at);
      break;

    case 5: {  // a piece of another one
      const string& other = seeds_[draw(seeds_.size())];
      const size_t from = draw(other.size() + 1);
      bytes.insert(at, other.substr(from, 1 + draw(64)));
      break;
    }

    case 6:  // an odd number in place of digits
      for (size_t k = at; k < bytes.size(); ++k)
        if (bytes[k] >= '0' && bytes[k] <= '9') {
          static constexpr const char* odd[] = {"0", "-1", "1e308", "4294967296", "1e-320", "0.1", "999999999", "nan"};
          bytes.replace(k, 1, odd[draw(std::size(odd))]);
          break;
        }
      break;

    default:  // a word
      if (!words_.empty()) bytes.insert(at, words_[draw(words_.size())]);
  }
}

string Mutator::next(size_t longest) {
  string bytes = seeds_[draw(seeds_.size())];
  for (uint64_t k = 1 + draw(4); k > 0; --k) change(bytes);
  if (bytes.size() > longest) bytes.resize(longest);
  return bytes;
}

}  // namespace carom::fuzz
