#pragma once
// Numbers of bodies in a problem of their own, such as a step of an island.

#include "numerics/lazy_array.h"
#include "physics/entity.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

/// The bodies of one problem and their numbers in it, from 0 on in the order of the list. One problem at a time has
/// numbers: they are taken back when this object ends.
class Numbering {
 public:
  static constexpr uint32_t none = ContactConstraint::fixed;
  /// By body: its number; common to all problems, and `none` between them.
  using Numbers = LazyArray<uint32_t>;

  /// `numbers` must outlive this object.
  explicit Numbering(Numbers& numbers) : numbers_(&numbers) {}
  Numbering(Numbers& numbers, const vector<Entity>& bodies) : Numbering(numbers) {
    for (const Entity i : bodies) add(i);
  }
  Numbering(const Numbering&) = delete;
  Numbering& operator=(const Numbering&) = delete;
  Numbering(Numbering&& other) noexcept : numbers_(other.numbers_), bodies_(exchange(other.bodies_, {})) {}
  Numbering& operator=(Numbering&&) = delete;
  ~Numbering() {
    for (const Entity i : bodies_) numbers_->write(i) = none;
  }

  /// Adds body i, unless it is there. Returns whether it was not.
  bool add(Entity i) {
    if ((*numbers_)[i] != none) return false;
    numbers_->write(i) = uint32_t(bodies_.size());
    bodies_.push_back(i);
    return true;
  }
  /// The number of body i, or `none`, also for no_entity; and the body of a number.
  uint32_t number(Entity i) const { return i == no_entity ? none : (*numbers_)[i]; }
  Entity operator[](size_t k) const { return bodies_[k]; }

  // In the order of their numbers.
  const vector<Entity>& bodies() const { return bodies_; }
  size_t size() const { return bodies_.size(); }
  Entity front() const { return bodies_.front(); }
  auto begin() const { return bodies_.begin(); }
  auto end() const { return bodies_.end(); }

 private:
  Numbers* numbers_;
  vector<Entity> bodies_;
};

}  // namespace carom
