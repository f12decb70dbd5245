#pragma once
// The state of objects as bytes, and back. A class lists what changes in it in a member template `keep(archive)`, once
// for both directions. Members that the same World, State and options determine are not listed, nor are scratch and
// caches. The bytes are those of this processor and this version of the program.
#include <cstring>
#include <deque>
#include <type_traits>
#include <variant>

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct World;

/// Bytes do not fit the object that is restored from them.
struct ArchiveError : runtime_error {
  ArchiveError() : runtime_error("a saved state is damaged, or it belongs to another scene or version") {}
};

/// Appends bytes. It only reads the state.
class ByteWriter {
 public:
  static constexpr bool reads = false;

  string take() { return std::move(bytes_); }

 protected:
  void bytes(const void* from, size_t count) {
    if (count > 0) bytes_.append(static_cast<const char*>(from), count);
  }
  void require(bool /*fits*/) const {}
  void check_left(uint64_t /*count*/) const {}

  /// The number of a shared value, from 1 on in the order in which they are met; 0: none.
  uint64_t number_of(const void* shared) const {
    if (shared == nullptr) return 0;
    const auto known = numbers_.find(shared);
    return known == numbers_.end() ? numbers_.size() + 1 : known->second;
  }
  /// Takes the shared value of this number. Returns whether it is new, so that its contents follow.
  template <typename T>
  bool take_shared(const shared_ptr<T>& shared, uint64_t number) {
    return number > 0 && numbers_.try_emplace(shared.get(), number).second;
  }

 private:
  string bytes_;
  map<const void*, uint64_t> numbers_;
};

/// Reads them. Throws ArchiveError.
class ByteReader {
 public:
  static constexpr bool reads = true;

  /// `world`: that of the objects.
  ByteReader(string_view bytes, const World& world) : left_(bytes), world_(world) {}
  /// To be called at the end: all bytes must have been read.
  void finish() const { require(left_.empty()); }

 protected:
  void bytes(void* to, size_t count) {
    check_left(count);
    if (count > 0) std::memcpy(to, left_.data(), count);
    left_.remove_prefix(count);
  }
  void require(bool fits) const {
    if (!fits) throw ArchiveError();
  }
  /// So many values can follow: each takes a byte at least.
  void check_left(uint64_t count) const { require(count <= left_.size()); }

  uint64_t number_of(const void* /*shared*/) const { return 0; }
  template <typename T>
  bool take_shared(shared_ptr<T>& shared, uint64_t number) {
    require(number <= known_.size() + 1);
    if (number <= known_.size()) {
      shared = number == 0 ? nullptr : std::static_pointer_cast<T>(known_[number - 1]);
      return false;
    }

    if constexpr (std::is_constructible_v<T, const World&>)
      shared = make_shared<T>(world_);
    else
      shared = make_shared<T>();
    known_.push_back(shared);
    return true;
  }

 private:
  string_view left_;
  const World& world_;
  vector<shared_ptr<void>> known_;  // shared values, by number
};

template <typename Bytes>
class StateArchive : public Bytes {
 public:
  using Bytes::Bytes;

  /// Writes the values, or reads them. Not inline, so that the event loop's functions are.
  template <typename... Values>
  [[gnu::cold, gnu::noinline]] void operator()(Values&... values) {
    (one(values), ...);
  }
  /// The same for sequences whose lengths do not change.
  template <typename... Lists>
  void sized(Lists&... lists) {
    (one_of_size(lists, lists.size()), ...);
  }
  /// Values that the restored object must have already.
  template <typename... Values>
  void same(const Values&... values) {
    (one_same(values), ...);
  }
  /// What must be so of values that were read.
  void check(bool fits) const { Bytes::require(fits); }

 private:
  template <typename T>
  static constexpr bool has_list = requires(T& value, StateArchive& archive) {
    value.keep(archive);
  };
  /// Its bytes are its value. Types with padding should have a list, so that equal states have equal bytes.
  template <typename T>
  static constexpr bool is_plain = std::is_same_v<T, Vec3> || (std::is_trivially_copyable_v<T> && !has_list<T>);

  template <typename T>
  void one(T& value) {
    if constexpr (has_list<T>) {
      value.keep(*this);
    } else {
      static_assert(is_plain<T> && !std::is_pointer_v<T>, "a type without a list of its members");
      Bytes::bytes(&value, sizeof value);
    }
  }

  template <typename T, typename Allocator>
  void one(vector<T, Allocator>& list) {
    resize(list);
    if constexpr (is_plain<T>)
      Bytes::bytes(list.data(), list.size() * sizeof(T));
    else
      for (T& value : list) one(value);
  }
  void one(string& text) {
    resize(text);
    Bytes::bytes(text.data(), text.size());
  }
  template <typename Key, typename T>
  void one(map<Key, T>& map) {
    vector<pair<Key, T>> entries(map.begin(), map.end());
    one(entries);
    if constexpr (Bytes::reads) map = {entries.begin(), entries.end()};
  }
  template <typename T>
  void one(std::deque<T>& list) {
    resize(list);
    for (T& value : list) one(value);
  }
  template <typename T, size_t size>
  void one(array<T, size>& list) {
    for (T& value : list) one(value);
  }
  template <typename First, typename Second>
  void one(pair<First, Second>& pair) {
    one(pair.first);
    one(pair.second);
  }
  template <typename T>
  void one(optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (there && !value) value.emplace();
    if (!there) value.reset();
    if (there) one(*value);
  }
  template <typename... Types>
  void one(std::variant<Types...>& value) {
    size_t index = value.index();
    one(index);
    if constexpr (Bytes::reads) {
      size_t k = 0;
      ((k++ == index ? (void)value.template emplace<Types>() : (void)0), ...);
    }
    std::visit([this](auto& held) { this->one(held); }, value);
  }
  /// Values that several share are written once.
  template <typename T>
  void one(shared_ptr<T>& value) {
    auto shared = std::const_pointer_cast<std::remove_const_t<T>>(value);
    uint64_t number = Bytes::number_of(shared.get());
    one(number);
    if (Bytes::take_shared(shared, number)) one(*shared);
    value = shared;
  }

  template <typename List>
  void resize(List& list) {
    uint64_t count = list.size();
    one(count);
    Bytes::check_left(count);
    if constexpr (Bytes::reads) list.resize(count);
  }
  template <typename List>
  void one_of_size(List& list, size_t size) {
    one(list);
    Bytes::require(list.size() == size);
  }
  template <typename T>
  void one_same(const T& value) {
    T read = value;
    one(read);
    Bytes::require(read == value);
  }
};

using StateWriter = StateArchive<ByteWriter>;
using StateReader = StateArchive<ByteReader>;

}  // namespace carom
